#include "wound/healing/area_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <sstream>

#include "base/file.hpp"
#include "base/input_error.hpp"

namespace wound {

namespace {

using Row = std::vector<std::string>;

constexpr double largest_plausible_ratio = 1e4; // area / first area; a larger one is an error of the table

std::string trimmed(std::string_view text)
{
    constexpr std::string_view blank = " \t\r\"";
    const auto first = text.find_first_not_of(blank);
    return first == text.npos ? ""
                              : std::string(text.substr(first, text.find_last_not_of(blank) - first + 1));
}

std::string lower(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

Row split(const std::string& line, char separator)
{
    Row cells;
    std::string cell;
    bool quoted = false;
    for (char c : line) {
        quoted ^= c == '"';
        if (c == separator && !quoted) {
            cells.push_back(trimmed(cell));
            cell.clear();
        } else
            cell += c;
    }
    cells.push_back(trimmed(cell));
    return cells;
}

std::optional<double> number(std::string text, bool decimal_comma)
{
    if (decimal_comma)
        std::replace(text.begin(), text.end(), ',', '.');
    const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
    double value = 0;
    const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
        return std::nullopt;
    return value;
}

bool is_missing(const std::string& cell)
{
    const std::string word = lower(cell);
    return word.empty() || word == "na" || word == "n/a" || word == "-";
}

struct Columns
{
    int day = -1, wound = -1, group = -1, weight = -1;
    std::vector<int> areas, edges;
    bool ratio = false; // `areas` are already relative to the first day
};

struct Reader
{
    std::string_view where;
    bool decimal_comma = false;
    Columns columns;

    [[noreturn]] void refuse(std::string_view what, std::string_view cure) const
    {
        throw base::InputError(where, what, cure);
    }

    double value(const Row& row, int column, int line, std::string_view name) const
    {
        const auto parsed = number(row[column], decimal_comma);
        if (!parsed || !std::isfinite(*parsed) || *parsed < 0)
            refuse(fmt::format("line {}: {} \"{}\" is not a number of at least 0", line, name, row[column]),
                   "correct the cell or leave it empty");
        return *parsed;
    }
};

Columns columns_of(const Row& header, const Reader& reader)
{
    Columns columns;
    for (int i = 0; i < static_cast<int>(header.size()); ++i) {
        const std::string name = lower(header[i]);
        if (name.starts_with("day") || name == "t" || name.starts_with("time"))
            columns.day = i;
        else if (name.starts_with("area") || name.starts_with("ratio")) {
            columns.areas.push_back(i);
            columns.ratio = name.starts_with("ratio");
        } else if (name.starts_with("wound") || name.starts_with("series") || name.starts_with("name"))
            columns.wound = i;
        else if (name.starts_with("group"))
            columns.group = i;
        else if (name.starts_with("weight"))
            columns.weight = i;
        else if (name.starts_with("edge") || name.starts_with("quality"))
            columns.edges.push_back(i);
    }
    if (columns.day < 0 || columns.areas.empty())
        reader.refuse("the header names no day column, or no area or ratio column",
                      "name the columns day and area (or ratio)");
    return columns;
}

bool unreliable(const Row& row, const Columns& columns)
{
    const auto bad = [&row](int column) {
        const std::string word = lower(row[column]);
        return word == "imagined" || word == "bad" || word == "0";
    };
    return !columns.edges.empty() && std::all_of(columns.edges.begin(), columns.edges.end(), bad);
}

/// Sums over the measurements of one wound on one day.
struct Measured
{
    double area = 0, weight = 0;
};

/// All rows of one wound.
struct Rows
{
    std::string name, group;
    std::map<double, Measured> days;
    int left_out = 0;
};

Rows& rows_of(std::vector<Rows>& wounds, const Row& row, const Columns& columns)
{
    const auto cell = [&row](int column) { return column < 0 ? std::string() : row[column]; };
    const std::string name = cell(columns.wound).empty() ? "wound" : cell(columns.wound);
    const auto known = std::ranges::find(wounds, name, &Rows::name);
    if (known != wounds.end())
        return *known;
    const std::string group = columns.group < 0 ? name.substr(0, name.find('-')) : cell(columns.group);
    return wounds.emplace_back(Rows{name, group, {}, 0});
}

AreaSeries series_of(const Rows& rows, const Reader& reader)
{
    AreaSeries series;
    const auto& [name, group, days, left_out] = rows;
    series.name = name;
    series.group = group;
    series.left_out = left_out;
    const auto first = days.begin();
    const double initial = reader.columns.ratio ? 1 : first->second.area / first->second.weight;
    series.initial_area = initial;
    if (!(initial > 0))
        reader.refuse(fmt::format("{}: the area on its first day is 0", name),
                      "start with the day on which the wound is open");
    for (const auto& [day, measured] : days) {
        series.days.push_back(day - first->first);
        series.ratios.push_back(measured.area / measured.weight / initial);
        if (!(series.ratios.back() <= largest_plausible_ratio))
            reader.refuse(fmt::format("{}: on day {} the area is {:.3g} times that of the first day", name,
                                      day, series.ratios.back()),
                          "correct the table: no wound grows that much");
        series.weights.push_back(measured.weight);
    }
    return series;
}

} // namespace

std::vector<AreaSeries> read_area_table(const std::filesystem::path& file)
{
    constexpr std::size_t largest = 64u << 20;
    const auto bytes = base::read_file(file, largest);
    std::istringstream text(std::string(bytes.begin(), bytes.end()));
    return read_area_table(text, file.string());
}

std::vector<AreaSeries> read_area_table(std::istream& text, std::string_view where)
{
    Reader reader{where, false, {}};
    std::vector<Rows> wounds;
    std::string line;
    char separator = 0;
    std::size_t number_of_columns = 0;
    for (int number_of_line = 1; std::getline(text, line); ++number_of_line) {
        if (number_of_line == 1 && line.starts_with("\xEF\xBB\xBF")) // byte order mark
            line.erase(0, 3);
        if (trimmed(line).empty() || line.starts_with('#'))
            continue;
        if (separator == 0) {
            separator = line.find(';') != line.npos ? ';' : line.find('\t') != line.npos ? '\t' : ',';
            reader.decimal_comma = separator != ',';
            const Row header = split(line, separator);
            if (number(header.front(), reader.decimal_comma)) { // no header
                if (header.size() != 2)
                    reader.refuse(
                        fmt::format("has no header and {} columns, not the two day and area", header.size()),
                        "name the columns; where commas are decimal, separate by semicolons");
                number_of_columns = 2;
                reader.columns.day = 0;
                reader.columns.areas = {1};
            } else {
                reader.columns = columns_of(header, reader);
                number_of_columns = header.size();
                continue;
            }
        }
        const Columns& columns = reader.columns;
        Row row = split(line, separator);
        const int needed = 1 + std::max({columns.day, columns.wound, columns.group, columns.weight,
                                         *std::max_element(columns.areas.begin(), columns.areas.end()),
                                         columns.edges.empty() ? 0 : columns.edges.back()});
        if (static_cast<int>(row.size()) < needed)
            reader.refuse(fmt::format("line {} has {} columns of {}", number_of_line, row.size(), needed),
                          "fill the row");
        while (row.size() > number_of_columns && row.back().empty())
            row.pop_back();
        if (row.size() > number_of_columns)
            reader.refuse(fmt::format("line {} has {} columns, the header {}", number_of_line, row.size(),
                                      number_of_columns),
                          "name every column; where commas are decimal, separate by semicolons");
        double sum = 0;
        int readers = 0;
        for (int column : columns.areas)
            if (!is_missing(row[column])) {
                sum += reader.value(row, column, number_of_line, "area");
                ++readers;
            }
        const bool weighted = columns.weight >= 0 && !is_missing(row[columns.weight]);
        const double weight = weighted ? reader.value(row, columns.weight, number_of_line, "weight") : 1;
        if (readers == 0)
            continue;
        Rows& wound = rows_of(wounds, row, columns);
        if (weight == 0 || unreliable(row, columns)) {
            ++wound.left_out;
            continue;
        }
        Measured& measured = wound.days[reader.value(row, columns.day, number_of_line, "day")];
        measured.area += weight * sum / readers;
        measured.weight += weight;
    }
    std::vector<AreaSeries> series;
    for (const Rows& wound : wounds)
        if (!wound.days.empty())
            series.push_back(series_of(wound, reader));
    if (series.empty())
        reader.refuse("the table holds no measurement", "give rows of day and area");
    return series;
}

AreaSeries mean_series(const std::vector<AreaSeries>& series, MeanOf of)
{
    double mean_initial = 0;
    for (const AreaSeries& one : series)
        mean_initial += one.initial_area / static_cast<double>(series.size());
    std::map<double, Measured> days;
    for (const AreaSeries& one : series)
        for (std::size_t i = 0; i < one.days.size(); ++i) {
            days[one.days[i]].area +=
                one.ratios[i] * (of == MeanOf::Ratios ? 1 : one.initial_area / mean_initial);
            days[one.days[i]].weight += 1;
        }
    AreaSeries mean;
    mean.name = "mean";
    for (const AreaSeries& one : series)
        mean.left_out += one.left_out;
    for (const auto& [day, sum] : days) {
        mean.days.push_back(day);
        mean.ratios.push_back(sum.area / sum.weight);
        mean.weights.push_back(1);
    }
    return mean;
}

std::vector<AreaSeries> group_means(const std::vector<AreaSeries>& series, MeanOf of)
{
    std::vector<std::vector<AreaSeries>> groups;
    for (const AreaSeries& one : series) {
        const auto known =
            std::ranges::find_if(groups, [&](const auto& group) { return group.front().group == one.group; });
        if (known == groups.end())
            groups.push_back({one});
        else
            known->push_back(one);
    }
    std::vector<AreaSeries> means;
    for (const std::vector<AreaSeries>& group : groups)
        if (groups.size() > 1 && group.size() > 1) {
            means.push_back(mean_series(group, of));
            means.back().group = group.front().group;
            means.back().name += " " + group.front().group;
        }
    return means;
}

} // namespace wound
