// Reads and writes the values of fields that have no builder: places, healing, hints, days, views.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "scene/field_table.hpp"

namespace scene {

// All readers throw base::InputError naming file and field.

head::Place read_place(base::Fields& fields, const head::Place& fallback);
nlohmann::json place_json(const head::Place& place);

/// A wound's `healing`: its usual_healing(), or H3's defaults if the scene says anything of the curve, with
/// the fields of the scene's `healing` and then those of its own (`own`, may be null; found at `where`).
void read_healing(Wound& wound, const nlohmann::json* own, const std::string& where, Reading& reading);
/// Leaves the course out if it is the usual one, so that it follows edits of the JSON.
nlohmann::json healing_json(const Wound& wound);

nlohmann::json hints_json(const wound::SegmentationHints& hints);

std::vector<double> read_days(const nlohmann::json& value, const std::string& where);

/// Appends the views of the field `views`.
void read_views(base::Fields& fields, std::vector<View>& views, Reading& reading);
nlohmann::json views_json(const std::vector<View>& views);

} // namespace scene
