#include "passes/reflectance_table.hpp"

#include <atomic>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <opencv2/imgproc.hpp>
#include <thread>
#include <unistd.h>

#include "wound/chromophores.hpp"

namespace passes {

namespace {

constexpr std::uint64_t table_version = 2; // raise when a rung's result or the mapping changes

// FNV-1a over the bit patterns of everything a table depends on.
class Key
{
  public:
    void add(std::uint64_t bits)
    {
        for (int byte = 0; byte < 8; ++byte) {
            hash_ ^= (bits >> (8 * byte)) & 0xFF;
            hash_ *= 0x100000001B3u;
        }
    }
    void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
    void add(const wound::Layer& layer)
    {
        for (double value : {layer.g, layer.n, layer.thickness_mm})
            add(value);
        for (const auto* values : {&layer.sigma_a, &layer.sigma_s_reduced}) {
            add(static_cast<std::uint64_t>(values->size()));
            for (double value : *values)
                add(value);
        }
    }
    std::uint64_t value() const { return hash_; }

  private:
    std::uint64_t hash_ = 0xCBF29CE484222325u;
};

std::uint64_t table_key(std::span<const wound::TissueDay> rows, std::uint32_t width, wound::Rung rung,
                        const wound::RungOptions& options)
{
    Key key;
    for (std::uint64_t bits :
         {table_version, static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(rung),
          static_cast<std::uint64_t>(options.incidence), static_cast<std::uint64_t>(options.fresnel),
          static_cast<std::uint64_t>(options.angles), static_cast<std::uint64_t>(options.quadrature),
          options.photons, options.seed})
        key.add(bits);
    for (const wound::TissueDay& day : rows) {
        for (double value : {day.missing_ratio, day.regrown_ratio, day.intact.n_above, day.intact.n_below})
            key.add(value);
        key.add(day.cover);
        key.add(day.regrown);
        key.add(static_cast<std::uint64_t>(day.intact.layers.size()));
        for (const wound::Layer& layer : day.intact.layers)
            key.add(layer);
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

// Written under another name first, so that a reader never meets half a table.
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

cv::Mat3f bake_reflectance_table(std::span<const wound::TissueDay> rows, std::uint32_t width,
                                 wound::Rung rung, const wound::RungOptions& options)
{
    const auto columns = static_cast<int>(width), count = static_cast<int>(rows.size()) * columns;
    cv::Mat3f table(static_cast<int>(rows.size()), columns);
    const auto deepest = static_cast<float>(deepest_injury_mm(rows.front().intact));
    std::atomic<int> next{0};
    const std::thread::id caller = std::this_thread::get_id();
    // Whoever stops, by progress that threw, stops all.
    struct Stop
    {
        std::atomic<int>& next;
        int count;
        ~Stop() { next = count; }
    };
    const auto work = [&] {
        const Stop stop{next, count};
        wound::RungOptions alone = options;
        alone.threads = 1;
        alone.progress = {};
        for (int i; (i = next++) < count;) {
            const int y = i / columns, x = i % columns;
            const float injury =
                shared::lut_value(static_cast<float>(x), static_cast<float>(columns), deepest);
            const wound::TissueDay& day = rows[static_cast<std::size_t>(y)];
            const wound::Color color = wound::tissue_color(wound::layers_at(day, injury), rung, alone);
            for (int c = 0; c < 3; ++c) // as displayable() in shaders/lib/reflectance.glsl
                table(y, x)[c] = color[c] > 0 ? static_cast<float>(std::min(color[c], 65504.0)) : 0.0f;
            if (options.progress && std::this_thread::get_id() == caller)
                options.progress(static_cast<double>(i + 1) / count);
        }
    };
    std::vector<std::jthread> threads;
    for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i)
        threads.emplace_back(work);
    work();
    threads.clear(); // joins
    return table;
}

cv::Mat3f cached_reflectance_table(const std::filesystem::path& folder,
                                   std::span<const wound::TissueDay> rows, std::uint32_t width,
                                   wound::Rung rung, const wound::RungOptions& options)
{
    const std::filesystem::path path =
        folder / fmt::format("reflectance-{:016x}-{}x{}.rgb32f", table_key(rows, width, rung, options), width,
                             rows.size());
    cv::Mat3f table(static_cast<int>(rows.size()), static_cast<int>(width));
    if (read_table(path, table))
        return table;
    table = bake_reflectance_table(rows, width, rung, options);
    write_table(path, table);
    return table;
}

engine::Texture upload_reflectance_table(const engine::Device& device, const cv::Mat3f& table,
                                         const std::string& name)
{
    cv::Mat rgba, half;
    cv::cvtColor(table, rgba, cv::COLOR_RGB2RGBA);
    rgba.convertTo(half, CV_16F);
    return engine::Texture(device, half, engine::Encoding::Linear, false, name);
}

wound::Color sample_table(const cv::Mat3f& table, const shared::LutAxes& axes, shared::uint part,
                          double injury_mm, double day)
{
    const shared::vec2 size(static_cast<float>(table.cols), static_cast<float>(table.rows));
    const shared::vec2 uv = lut_uv(axes, part, static_cast<float>(injury_mm), static_cast<float>(day), size);
    const double x = uv.x * size.x - .5, y = uv.y * size.y - .5;
    const int x0 = std::clamp(static_cast<int>(std::floor(x)), 0, table.cols - 1),
              x1 = std::min(x0 + 1, table.cols - 1);
    const int y0 = std::clamp(static_cast<int>(std::floor(y)), 0, table.rows - 1),
              y1 = std::min(y0 + 1, table.rows - 1);
    const double fx = x - x0, fy = y - y0;
    const wound::Color upper = (1 - fx) * wound::Color(table(y0, x0)) + fx * wound::Color(table(y0, x1));
    const wound::Color lower = (1 - fx) * wound::Color(table(y1, x0)) + fx * wound::Color(table(y1, x1));
    return (1 - fy) * upper + fy * lower;
}

} // namespace passes
