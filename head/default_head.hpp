// Where the default head lies once cicatrix-fetch-head has made it.
#pragma once
#include <filesystem>

namespace head {

/// Goes up whenever the default head changes; part of its file's name.
constexpr int default_head_version = 2;

/// head-vN.glb in base::cache_folder(). It need not be there.
std::filesystem::path default_head_path();

} // namespace head
