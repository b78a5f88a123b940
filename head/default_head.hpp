// Path of the default head, which cicatrix-fetch-head creates.
#pragma once
#include <filesystem>

namespace head {

/// Part of the file name; increase it whenever the default head changes.
constexpr int default_head_version = 2;

/// head-vN.glb in base::cache_folder(). The file may be missing.
std::filesystem::path default_head_path();

} // namespace head
