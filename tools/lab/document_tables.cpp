#include "tools/lab/document_tables.hpp"

#include <fmt/format.h>

#include "base/file.hpp"
#include "base/input_error.hpp"

namespace lab {

void replace_tables(const std::filesystem::path& document,
                    const std::vector<std::pair<std::string, std::string>>& tables)
{
    const std::vector<std::uint8_t> bytes = base::read_file(document, 1 << 20);
    std::string text(bytes.begin(), bytes.end());
    for (const auto& [name, table] : tables) {
        const std::string begin = fmt::format("<!-- table {} -->\n", name), end = "<!-- end -->";
        const std::size_t first = text.find(begin);
        const std::size_t last = first == std::string::npos ? first : text.find(end, first);
        if (last == std::string::npos)
            throw base::InputError(
                document.string(), fmt::format("has no markers for the table of {}", name),
                fmt::format("write a line {} and below it {}", begin.substr(0, begin.size() - 1), end));
        text.replace(first + begin.size(), last - first - begin.size(), table);
    }
    base::write_text(document, text);
}

} // namespace lab
