// Tables that a command makes and a document holds.
#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace lab {

/// Replaces the text between "<!-- table NAME -->" and "<!-- end -->" by the table, for each name and table. Throws
/// base::InputError when a marker is missing.
void replace_tables(const std::filesystem::path& document,
                    const std::vector<std::pair<std::string, std::string>>& tables);

} // namespace lab
