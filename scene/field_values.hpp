// Reads and writes the values of fields that have no builder: places, hints, days, views.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "scene/field_table.hpp"

namespace scene {

// All readers throw base::InputError naming file and field.

head::Place read_place(base::Fields& fields, const head::Place& fallback);
nlohmann::json place_json(const head::Place& place);

nlohmann::json hints_json(const wound::SegmentationHints& hints);

std::vector<double> read_days(const nlohmann::json& value, const std::string& where);

/// Appends the views of the field `views`.
void read_views(base::Fields& fields, std::vector<View>& views, Reading& reading);
nlohmann::json views_json(const std::vector<View>& views);

} // namespace scene
