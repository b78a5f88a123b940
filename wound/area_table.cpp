#include "wound/area_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <map>
#include <optional>

#include "wound/input_error.hpp"

namespace wound {

namespace {

using Row = std::vector<std::string>;

std::string trimmed(std::string_view text)
{
    constexpr std::string_view kBlank = " \t\r\"";
    const auto first = text.find_first_not_of(kBlank);
    return first == text.npos ? ""
                              : std::string(text.substr(first, text.find_last_not_of(kBlank) - first + 1));
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
    int day = -1, wound = -1, weight = -1;
    std::vector<int> areas, edges;
    bool ratio = false; // already relative to the first day
};

struct Reader
{
    std::string_view where;
    bool decimal_comma = false;
    Columns columns;

    [[noreturn]] void refuse(std::string_view what, std::string_view cure) const
    {
        throw cicatrix::InputError(where, what, cure);
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

AreaSeries series_of(const std::string& name, const std::map<double, Measured>& days, const Reader& reader)
{
    AreaSeries series;
    series.name = name;
    const auto first = days.begin();
    const double initial = reader.columns.ratio ? 1 : first->second.area / first->second.weight;
    series.initial_area = initial;
    if (!(initial > 0))
        reader.refuse(fmt::format("wound {}: the area on its first day is 0", name),
                      "start with the day on which the wound is open");
    for (const auto& [day, measured] : days) {
        series.days.push_back(day - first->first);
        series.ratios.push_back(measured.area / measured.weight / initial);
        series.weights.push_back(measured.weight);
    }
    return series;
}

} // namespace

std::vector<AreaSeries> read_area_table(const std::filesystem::path& file)
{
    std::ifstream text(file);
    if (!text)
        throw cicatrix::InputError(file.string(), "cannot be read", "give a CSV file of days and areas");
    return read_area_table(text, file.string());
}

std::vector<AreaSeries> read_area_table(std::istream& text, std::string_view where)
{
    Reader reader{where, false, {}};
    std::vector<std::string> order;
    std::map<std::string, std::map<double, Measured>> wounds;
    std::string line;
    char separator = 0;
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
                if (header.size() < 2)
                    reader.refuse("a row has fewer than two columns", "give day and area");
                reader.columns.day = 0;
                reader.columns.areas = {1};
            } else {
                reader.columns = columns_of(header, reader);
                continue;
            }
        }
        const Columns& columns = reader.columns;
        Row row = split(line, separator);
        const int needed = 1 + std::max({columns.day, columns.wound, columns.weight,
                                         *std::max_element(columns.areas.begin(), columns.areas.end()),
                                         columns.edges.empty() ? 0 : columns.edges.back()});
        if (static_cast<int>(row.size()) < needed)
            reader.refuse(fmt::format("line {} has {} columns of {}", number_of_line, row.size(), needed),
                          "fill the row");
        double sum = 0;
        int readers = 0;
        for (int column : columns.areas)
            if (!is_missing(row[column])) {
                sum += reader.value(row, column, number_of_line, "area");
                ++readers;
            }
        const bool weighted = columns.weight >= 0 && !is_missing(row[columns.weight]);
        const double weight = weighted ? reader.value(row, columns.weight, number_of_line, "weight") : 1;
        if (readers == 0 || weight == 0 || unreliable(row, columns))
            continue;
        const std::string name =
            columns.wound >= 0 && !row[columns.wound].empty() ? row[columns.wound] : "wound";
        if (!wounds.contains(name))
            order.push_back(name);
        Measured& measured = wounds[name][reader.value(row, columns.day, number_of_line, "day")];
        measured.area += weight * sum / readers;
        measured.weight += weight;
    }
    if (order.empty())
        reader.refuse("the table holds no measurement", "give rows of day and area");
    std::vector<AreaSeries> series;
    for (const std::string& name : order)
        series.push_back(series_of(name, wounds[name], reader));
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
                one.ratios[i] * (of == MeanOf::ratios ? 1 : one.initial_area / mean_initial);
            days[one.days[i]].weight += 1;
        }
    AreaSeries mean;
    mean.name = "mean";
    for (const auto& [day, sum] : days) {
        mean.days.push_back(day);
        mean.ratios.push_back(sum.area / sum.weight);
        mean.weights.push_back(1);
    }
    return mean;
}

} // namespace wound
