// Pictures in the cache folder: the sums of a path-traced picture, from which it can go on.
#pragma once
#include <filesystem>
#include <string>

#include "reference/truth.hpp"

namespace reference {

std::filesystem::path kept_path(std::uint64_t key);

/// Fills picture, CPU time and tissue when the file is there and whole and of the picture's size; else the
/// truth is as it was.
void read_kept(const std::filesystem::path& path, Truth& truth);

/// Atomic. Returns why it could not be kept; nothing when it was.
std::string write_kept(const std::filesystem::path& path, const Truth& truth);

} // namespace reference
