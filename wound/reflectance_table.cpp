#include "wound/reflectance_table.hpp"

#include <atomic>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <thread>
#include <unistd.h>

#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "base/sampling.hpp"
#include "wound/optics/chromophores.hpp"

namespace wound {

namespace {

constexpr std::uint64_t table_version = 3; // raise when a model's result or the mapping changes

void add(base::Hash& key, const optics::Layer& layer)
{
    key.add(layer.g).add(layer.n).add(layer.thickness_mm);
    for (const auto* values : {&layer.sigma_a, &layer.sigma_s_reduced})
        key.add(std::as_bytes(std::span(*values)));
}

/// Hash of the inputs of a table.
std::uint64_t table_key(std::span<const optics::TissueDay> rows, std::uint32_t width,
                        optics::ReflectanceModel model, const optics::ReflectanceOptions& options)
{
    base::Hash key;
    key.add(table_version).add(width).add(model).add(options.incidence).add(options.fresnel);
    key.add(options.angles).add(options.quadrature).add(options.photons).add(options.seed);
    for (const optics::TissueDay& day : rows) {
        key.add(day.missing_ratio).add(day.regrown_ratio).add(day.intact.n_above).add(day.intact.n_below);
        add(key, day.cover);
        add(key, day.regrown);
        key.add(day.intact.layers.size());
        for (const optics::Layer& layer : day.intact.layers)
            add(key, layer);
    }
    return key.value();
}

bool finite(const cv::Mat3f& table)
{
    for (const cv::Vec3f& texel : table)
        for (int c = 0; c < 3; ++c)
            if (!(texel[c] >= 0 && std::isfinite(texel[c])))
                return false;
    return true;
}

bool read_table(const std::filesystem::path& path, cv::Mat3f& table)
{
    std::ifstream file(path, std::ios::binary);
    const auto bytes = static_cast<std::streamsize>(table.total() * table.elemSize());
    return file && file.read(reinterpret_cast<char*>(table.data), bytes) &&
           file.peek() == std::ifstream::traits_type::eof() && finite(table);
}

// Writes a temporary file and renames it, so that no reader gets an incomplete table.
void write_table(const std::filesystem::path& path, const cv::Mat3f& table)
{
    std::error_code error;
    std::filesystem::create_directories(path.parent_path(), error);
    const std::filesystem::path temporary = fmt::format("{}.{}", path.string(), getpid());
    std::ofstream file(temporary, std::ios::binary);
    file.write(reinterpret_cast<const char*>(table.data),
               static_cast<std::streamsize>(table.total() * table.elemSize()));
    file.close();
    if (file)
        std::filesystem::rename(temporary, path, error);
    if (!file || error)
        std::filesystem::remove(temporary, error);
}

} // namespace

double lut_row_day(std::size_t row, std::size_t rows, double last_day)
{
    return shared::lut_value(static_cast<float>(row), static_cast<float>(rows), static_cast<float>(last_day));
}

LutRows lut_rows(const optics::HealingTissue& tissue, const Healing& healing, std::size_t rows,
                 double last_day)
{
    LutRows result;
    const double closed = closure_day(healing.curve);
    for (std::size_t row = 0; row < rows; ++row) {
        const double day = lut_row_day(row, rows, last_day);
        result.days.push_back(optics::open_bed(tissue, day, healing_at(healing, day).depth_scale));
    }
    for (std::size_t row = 0; row < rows; ++row)
        result.days.push_back(optics::covered_bed(tissue, lut_row_day(row, rows, last_day), closed));
    result.axes = {static_cast<float>(deepest_injury_mm(result.days.front().intact)),
                   static_cast<float>(last_day)};
    return result;
}

optics::TissueDay tissue_on(const optics::HealingTissue& tissue, shared::uint part, double day)
{
    const Healing healing;
    return part == shared::LUT_OPEN ? optics::open_bed(tissue, day, healing_at(healing, day).depth_scale)
                                    : optics::covered_bed(tissue, day, closure_day(healing.curve));
}

cv::Mat3f bake_reflectance_table(std::span<const optics::TissueDay> rows, std::uint32_t width,
                                 optics::ReflectanceModel model, const optics::ReflectanceOptions& options)
{
    const auto columns = static_cast<int>(width), count = static_cast<int>(rows.size()) * columns;
    cv::Mat3f table(static_cast<int>(rows.size()), columns);
    const auto deepest = static_cast<float>(deepest_injury_mm(rows.front().intact));
    std::atomic<int> finished{0};
    const std::thread::id caller = std::this_thread::get_id();
    optics::ReflectanceOptions alone = options;
    alone.threads = 1;
    alone.progress = {};
    base::in_parallel(std::size_t(count), 0, [&](std::size_t i) {
        const int y = int(i) / columns, x = int(i) % columns;
        const float injury = shared::lut_value(static_cast<float>(x), static_cast<float>(columns), deepest);
        const optics::TissueDay& day = rows[static_cast<std::size_t>(y)];
        const base::Color color =
            optics::tissue_color(optics::layers_at(day, injury, optics::is_the_papers(model)), model, alone);
        for (int c = 0; c < 3; ++c) // as displayable() in shaders/lib/reflectance.glsl
            table(y, x)[c] = color[c] > 0 ? static_cast<float>(std::min(color[c], 65504.0)) : 0.0f;
        const int done = ++finished;
        if (options.progress && std::this_thread::get_id() == caller)
            options.progress(static_cast<double>(done) / count);
    });
    return table;
}

cv::Mat3f cached_reflectance_table(const std::filesystem::path& folder,
                                   std::span<const optics::TissueDay> rows, std::uint32_t width,
                                   optics::ReflectanceModel model, const optics::ReflectanceOptions& options)
{
    const std::filesystem::path path =
        folder / fmt::format("reflectance-{:016x}-{}x{}.rgb32f", table_key(rows, width, model, options),
                             width, rows.size());
    cv::Mat3f table(static_cast<int>(rows.size()), static_cast<int>(width));
    if (read_table(path, table))
        return table;
    table = bake_reflectance_table(rows, width, model, options);
    write_table(path, table);
    return table;
}

cv::Mat3f kept_table(const LutRows& rows, std::uint32_t width, optics::ReflectanceModel model,
                     optics::ReflectanceOptions options)
{
    base::Progress progress;
    constexpr std::size_t steps = 100;
    std::size_t done = 0;
    progress.expect(steps);
    options.progress = [&](double share) {
        for (; static_cast<double>(done) < share * steps; ++done)
            progress.step();
        progress.show(fmt::format("reflectance table, {}", optics::name(model)));
    };
    return cached_reflectance_table(base::cache_folder(), rows.days, width, model, options);
}

base::Color sample_table(const cv::Mat3f& table, const shared::LutAxes& axes, shared::uint part,
                         double injury_mm, double day)
{
    const shared::vec2 size(static_cast<float>(table.cols), static_cast<float>(table.rows));
    const shared::vec2 uv = lut_uv(axes, part, static_cast<float>(injury_mm), static_cast<float>(day), size);
    return base::sample<3>(table, {uv.x, uv.y});
}

} // namespace wound
