#include "engine/window/ui.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <array>
#include <filesystem>
#include <imgui.h>
#include <imgui_impl_glfw.h>

#include "base/hash.hpp"

namespace window {

namespace {

constexpr float text_size = 15; // pixels at scale 1

/// First installed font of a list of common ones; empty: none is installed.
std::filesystem::path find_font()
{
    for (const char* path :
         {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
          "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf", "/usr/share/fonts/TTF/DejaVuSans.ttf",
          "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
          "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf"})
        if (std::filesystem::exists(path))
            return path;
    return {};
}

/// A dark, flat style: the face is the brightest thing on the screen.
void set_look(ImGuiStyle& style)
{
    ImGui::StyleColorsDark(&style);
    style.WindowPadding = {12, 10};
    style.FramePadding = {8, 4};
    style.ItemSpacing = {8, 6};
    style.ItemInnerSpacing = {6, 4};
    style.WindowRounding = style.TabRounding = 0;
    style.FrameRounding = style.GrabRounding = style.PopupRounding = 4;
    style.WindowBorderSize = 0;
    style.ScrollbarSize = 12;
    style.GrabMinSize = 10;
    const auto set = [&](ImGuiCol color, float r, float g, float b, float a = 1) {
        style.Colors[color] = {r, g, b, a};
    };
    set(ImGuiCol_WindowBg, .105f, .11f, .12f);
    set(ImGuiCol_PopupBg, .13f, .135f, .15f, .98f);
    set(ImGuiCol_MenuBarBg, .135f, .14f, .15f);
    set(ImGuiCol_Text, .89f, .89f, .88f);
    set(ImGuiCol_TextDisabled, .58f, .59f, .6f);
    set(ImGuiCol_FrameBg, .18f, .185f, .2f);
    set(ImGuiCol_FrameBgHovered, .23f, .24f, .26f);
    set(ImGuiCol_FrameBgActive, .27f, .28f, .3f);
    set(ImGuiCol_Button, .22f, .23f, .25f);
    set(ImGuiCol_ButtonHovered, .3f, .31f, .34f);
    set(ImGuiCol_ButtonActive, .62f, .33f, .28f);
    set(ImGuiCol_Header, .2f, .205f, .22f);
    set(ImGuiCol_HeaderHovered, .27f, .275f, .3f);
    set(ImGuiCol_HeaderActive, .33f, .335f, .36f);
    set(ImGuiCol_CheckMark, .93f, .55f, .45f);
    set(ImGuiCol_SliderGrab, .6f, .32f, .26f); // dark enough for the value that is drawn over it
    set(ImGuiCol_SliderGrabActive, .72f, .39f, .32f);
    set(ImGuiCol_Separator, .25f, .255f, .27f);
    set(ImGuiCol_TitleBgActive, .2f, .205f, .22f);
    set(ImGuiCol_PlotHistogram, .8f, .45f, .37f);
    set(ImGuiCol_ModalWindowDimBg, .03f, .03f, .035f, .6f);
    set(ImGuiCol_TextSelectedBg, .62f, .33f, .28f, .6f);
}

/// Of all that will be drawn.
std::uint64_t hash_of(const ImDrawData& data)
{
    base::Hash hash;
    hash.add(data.DisplaySize.x).add(data.DisplaySize.y);
    const auto bytes = [](const auto& vector) {
        return std::as_bytes(std::span(vector.Data, std::size_t(vector.Size)));
    };
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        hash.add(bytes(list.VtxBuffer)).add(bytes(list.IdxBuffer));
        for (const ImDrawCmd& draw : list.CmdBuffer)
            hash.add(draw.ElemCount)
                .add(draw.ClipRect.x)
                .add(draw.ClipRect.y)
                .add(draw.ClipRect.z)
                .add(draw.ClipRect.w)
                .add(reinterpret_cast<std::uintptr_t>(draw.GetTexID()));
    }
    return hash.value();
}

} // namespace

Ui::Ui(Window& window, double scale) : window_(window), forced_scale_(scale)
{
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;              // the program places its panels itself
    io.ConfigInputTextCursorBlink = false; // a blinking cursor would need redraws all the time
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    io.BackendRendererName = "cicatrix";
    ImGui_ImplGlfw_InitForVulkan(window_.handle(), true);
    window_.listen_to_keys(); // this ImGui version loses and reorders keys that come within one frame
    set_scale(wanted_scale());
}

Ui::~Ui()
{
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

float Ui::pixels_per_unit() const
{
    const float scale = ImGui::GetIO().DisplayFramebufferScale.x;
    return scale > 0 ? scale : 1;
}

float Ui::wanted_scale() const
{
    return forced_scale_ > 0 ? float(forced_scale_) : window_.content_scale() / pixels_per_unit();
}

void Ui::set_scale(float scale)
{
    current_scale_ = scale;
    fonts_changed_ = true;
    ImGuiStyle style;
    set_look(style);
    style.ScaleAllSizes(scale);
    ImGui::GetStyle() = style;
    ImGuiIO& io = ImGui::GetIO();
    io.Fonts->Clear();
    io.FontGlobalScale = 1;
    const std::filesystem::path font = find_font();
    if (font.empty() || io.Fonts->AddFontFromFileTTF(font.c_str(), text_size * scale) == nullptr) {
        ImFontConfig config;
        config.SizePixels = 13 * scale; // a bitmap font of 13 px
        io.Fonts->AddFontDefault(&config);
    }
}

void Ui::tell_keys(const FrameKeys& keys)
{
    ImGuiIO& io = ImGui::GetIO();
    for (const char32_t character : keys.text)
        io.AddInputCharacter(character);
    for (const KeyChange& change : keys.changes)
        if (std::size_t(change.key) < std::size(io.KeysDown))
            io.KeysDown[change.key] = change.down;
    const auto either = [&](int left, int right) { return io.KeysDown[left] || io.KeysDown[right]; };
    io.KeyCtrl = either(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL);
    io.KeyShift = either(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT);
    io.KeyAlt = either(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT);
}

void Ui::tell_mouse()
{
    ImGuiIO& io = ImGui::GetIO();
    if (const std::optional<ButtonChange> change = window_.take_button_change();
        change && std::size_t(change->button) < buttons_.size())
    {
        buttons_[std::size_t(change->button)] = change->down;
        io.MousePos = {change->at[0], change->at[1]};
    }
    std::ranges::copy(buttons_, io.MouseDown);
}

void Ui::begin(UiRenderer& renderer, const FrameKeys& keys)
{
    tell_keys(keys);
    ImGui_ImplGlfw_NewFrame();
    tell_mouse();
    if (const float scale = wanted_scale(); scale != current_scale_)
        set_scale(scale);
    if (fonts_changed_)
        renderer.upload_fonts();
    fonts_changed_ = false;
    ImGui::NewFrame();
}

const ImDrawData* Ui::end()
{
    ImGui::Render();
    last_hash_ = hash_;
    hash_ = hash_of(*ImGui::GetDrawData());
    return ImGui::GetDrawData();
}

} // namespace window
