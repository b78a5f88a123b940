// The demo's user interface: its state and the functions that draw it with Dear ImGui. They read and change
// the state; requests that need the device or a file are left in DemoState::Wishes for DemoWindow.
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

/// A rectangle in ImGui's units.
struct Rectangle
{
    float left = 0, top = 0, width = 0, height = 0;
};

/// What the mouse drags in the picture.
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
    Mode, // the other mode: published if the left half is corrected, and vice versa
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
    Recording, // progress of a film being recorded
    Area,      // rectangle around the wound in a photograph
    Help,
    Quit // asked when edits are not saved
};

/// Facts about the stage that the interface shows.
struct StageFacts
{
    std::vector<head::Anchor> anchors;     // of the placed wounds
    std::vector<std::size_t> scene_wounds; // for each anchor, the index of its wound in the scene
    Sight sight;                           // of the picture in the view
    glm::dvec3 head_middle{0};
    double camera_distance_m = 1; // from the target, also when the scene does not set it
    bool pending = false;         // wounds or tables are being prepared
};

struct DemoState
{
    scene::Scene scene;
    Playback playback;
    Notices notices;
    StageFacts stage;
    std::optional<std::size_t> selected; // index of a wound of the scene
    scene::Scene mended;                 // the corrected settings that published mode replaced
    Compare compare = Compare::Nothing;
    std::optional<scene::Scene> kept; // for comparison
    double divider = .5;              // position in the view, 0..1
    bool panels = true;
    bool loading = true;
    bool can_undo = false, can_redo = false;
    std::string device; // name of the Vulkan device
    float scale = 1;    // of the interface

    // Of the last picture.
    std::vector<gpu::PassResult> passes;
    double frame_ms = 0, render_scale = 1;

    Rectangle view, timeline; // set by draw_demo()
    bool moving = false;      // something is being dragged

    struct Mouse
    {
        Drag drag = Drag::None;
        float travelled = 0;   // since the button was pressed, ImGui units
        glm::dvec2 grip{0};    // offset from the pointer to the dragged point, 0..1 of the view
        bool on_wound = false; // the button was pressed on a wound
    } mouse;

    Dialog dialog = Dialog::None;
    struct Entries // in the dialogs
    {
        std::string path;
        std::array<int, 2> size{1280, 720};
        int frames_per_second = 25;
        double seconds = 10;
        // Area of a wound in a photograph.
        std::filesystem::path photo;
        const gpu::Texture* picture = nullptr;
        std::array<int, 2> pixels{};
        Rectangle shown;                     // where the photograph is drawn
        std::optional<cv::Rect2d> rectangle; // pixels of the photograph
        std::optional<std::size_t> wound;    // none: a new wound
        bool quit_when_saved = false;
    } entries;
    double recorded = 0;              // part of the film, 0..1
    std::filesystem::path scene_file; // last read or saved

    struct Wishes
    {
        bool quit = false, undo = false, redo = false;
        std::optional<glm::dvec2> wound_at; // put a new wound there; 0..1 of the view
        std::optional<glm::dvec2> move_to;  // move the selected wound there
        std::optional<std::filesystem::path> open, save_scene, save_picture, film;
        std::optional<std::size_t> photo_area; // show the dialog for this wound's photograph
        bool use_photo = false;                // with the rectangle in the dialog
        bool stop_film = false;
    } wishes;
};

/// Draws everything except the picture, which DemoWindow puts into `view`.
void draw_demo(DemoState& state);

// Parts of the interface, each in its own file.
void draw_timeline(DemoState& state);
void draw_panels(DemoState& state);
void draw_looks(DemoState& state); // panels for skin, light, shading and comparison
void draw_timing(DemoState& state);
void draw_view(DemoState& state); // overlays of the picture; handles the mouse in it
void draw_dialogs(DemoState& state);

/// Handles a key. `typing`: a text field has the focus, so only Ctrl keys and, in a dialog, Esc act.
void press(DemoState& state, const window::KeyPress& key, bool typing);
void draw_help(DemoState& state);

void open_dialog(DemoState& state, Dialog dialog);
void delete_selected(DemoState& state);

} // namespace demo_command
