// The demo's interface: what it shows and edits, and the functions that draw it with Dear ImGui. They read
// and change the state; whatever needs the device or a file is left as a wish for the window's loop.
#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/demo/edit.hpp"
#include "apps/demo/session.hpp"
#include "engine/gpu/executor.hpp"
#include "engine/gpu/texture.hpp"
#include "engine/window/window.hpp"
#include "head/placement.hpp"
#include "scene/scene.hpp"

namespace demo_command {

/// Where things are, in ImGui's units.
struct Rectangle
{
    float left = 0, top = 0, width = 0, height = 0;
};

/// What is dragged in the picture.
enum class Drag : std::uint8_t
{
    None,
    Turn, // the camera around the head
    Pan,
    Light,
    Wound,
    Width,
    Roll,
    Divider
};

/// What the right half of a split view shows.
enum class Compare : std::uint8_t
{
    Nothing,
    Mode, // what is corrected on the left as published, or the other way round
    Day0, // the day of the photograph
    Kept  // the settings that were kept
};

enum class Dialog : std::uint8_t
{
    None,
    Open,
    SaveScene,
    SavePicture,
    Film,
    Recording, // of a film, under way
    Area,      // of the wound in a photograph
    Help,
    Quit // with edits that are not saved
};

/// What only the stage knows and the interface shows.
struct StageFacts
{
    std::vector<head::Anchor> anchors;     // of the placed wounds
    std::vector<std::size_t> scene_wounds; // of which wound of the scene each is one
    Sight sight;                           // of the picture in the view
    glm::dvec3 head_middle{0};
    double camera_distance_m = 1; // the camera's, also where the scene leaves it open
    bool pending = false;         // workers are busy
};

struct DemoState
{
    scene::Scene scene;
    Playback playback;
    Notices notices;
    StageFacts stage;
    std::optional<std::size_t> selected; // wound of the scene
    scene::Scene mended;                 // what published mode replaced
    Compare compare = Compare::Nothing;
    std::optional<scene::Scene> kept; // for comparison
    double divider = .5;              // of the view
    bool panels = true;
    bool loading = true;
    bool can_undo = false, can_redo = false;
    std::string device; // its name
    float scale = 1;    // of the interface

    // Of the last picture.
    std::vector<gpu::PassResult> passes;
    double frame_ms = 0, render_scale = 1;

    Rectangle view, timeline; // laid out by draw_demo
    bool moving = false;      // something is being dragged

    struct Mouse
    {
        Drag drag = Drag::None;
        float travelled = 0;   // since the button went down
        glm::dvec2 grip{0};    // from the pointer to what is held, in 0..1 of the view
        bool on_wound = false; // what was pressed
    } mouse;

    Dialog dialog = Dialog::None;
    struct Entries // of the dialogs
    {
        std::string path;
        std::array<int, 2> size{1280, 720};
        int frames_per_second = 25;
        double seconds = 10;
        // Area of a wound in a photograph.
        std::filesystem::path photo;
        const gpu::Texture* picture = nullptr;
        std::array<int, 2> pixels{};
        Rectangle shown;                     // where the photograph is
        std::optional<cv::Rect2d> rectangle; // pixels of the photograph
        std::optional<std::size_t> wound;    // none: a new one
        bool quit_when_saved = false;
    } entries;
    double recorded = 0;              // of a film, 0..1
    std::filesystem::path scene_file; // where it was read from or saved to

    struct Wishes
    {
        bool quit = false, undo = false, redo = false;
        std::optional<glm::dvec2> wound_at; // put a new one there; 0..1 of the view
        std::optional<glm::dvec2> move_to;  // the selected one
        std::optional<std::filesystem::path> open, save_scene, save_picture, film;
        std::optional<std::size_t> photo_area; // show the dialog for this wound's photograph
        bool use_photo = false;                // as the dialog has it
        bool stop_film = false;
    } wishes;
};

/// Everything but the picture, which lies in `view`.
void draw_demo(DemoState& state);

// Parts of it, each in a file of its own.
void draw_timeline(DemoState& state);
void draw_panels(DemoState& state);
void draw_looks(DemoState& state); // panels for light, shading and comparison
void draw_timing(DemoState& state);
void draw_view(DemoState& state); // what lies over the picture, and the mouse in it
void draw_dialogs(DemoState& state);

/// `typing`: a text field has the keys, but for those with Ctrl and Esc in a dialog.
void press(DemoState& state, const window::KeyPress& key, bool typing);
void draw_help(DemoState& state);

void open_dialog(DemoState& state, Dialog dialog);
void delete_selected(DemoState& state);

} // namespace demo_command
