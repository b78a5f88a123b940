// `cicatrix compare --systems [SCENE]`: every system of light transport on the same head, by the same camera,
// in one run: what the rasteriser has (the table TRANSPORTS of shaders/shared/shading.h), Ward's BRDF as the
// paper has it, and the systems whose authors compute on the processor (reference/rival.hpp). Cost, error
// against the truth, memory, and which of the paper's claims hold.
#pragma once
#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/compare/against_reference.hpp"
#include "reference/rival.hpp"

namespace compare_command {

/// What is known of a system before it is measured.
struct SystemFacts
{
    std::string_view name, source; // in the paper's brackets: its reference
    std::string_view paper_fps;    // on its GeForce GTX 580; empty: not there
    std::string_view cannot;       // what the method cannot do
    /// Of a rival that spreads light: how many times as fast the proposed shading is in the paper; 1: not
    /// there.
    std::optional<double> paper_ratio;
};
/// Facts of a name without an entry: the name alone.
SystemFacts facts_of(std::string_view name);

struct System
{
    std::string name;
    std::optional<optics::Shading> shading;       // of the rasteriser
    std::optional<reference::RivalMethod> method; // on the processor
};
/// `own`: the scene's. Ward's comes first, because all ratios are to it.
std::vector<System> all_systems(const optics::Shading& own);

inline constexpr std::array<std::string_view, 4> system_cases{"still", "camera", "light", "day"};

/// What the measured record says of the paper's claims and of ours: "claim", "holds", "measured" (words).
/// Claims about systems that the record lacks are left out. `systems`: as systems.json has it.
nlohmann::json claims_of(const nlohmann::json& systems);

/// The page, from systems.json's contents. `picture`: the sheet's place relative to the page.
std::string systems_page(const nlohmann::json& record, const std::string& picture);

/// Writes systems.json, pictures and the page into options.out. Throws base::InputError. After Ctrl-C it
/// writes what is done.
void compare_systems(const CompareOptions& options);

} // namespace compare_command
