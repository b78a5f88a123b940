#include "head/default_head.hpp"

#include <fmt/format.h>

#include "base/file.hpp"

namespace head {

std::filesystem::path default_head_path()
{
    return base::cache_folder() / fmt::format("head-v{}.glb", default_head_version);
}

} // namespace head
