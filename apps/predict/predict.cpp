#include "apps/predict/predict.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "base/draw_text.hpp"
#include "base/file.hpp"
#include "base/image_io.hpp"
#include "base/input_error.hpp"
#include "base/json_fields.hpp"
#include "scene/file.hpp"
#include "wound/prepare.hpp"

namespace predict_command {
namespace {
using nlohmann::json;

struct SeriesPhoto
{
    double day = 0;
    std::filesystem::path photo, mask;
    wound::SegmentationHints hints; // used when `mask` is empty
};

struct SeriesFile
{
    std::filesystem::path areas;
    std::string series; // name of a series in the table; empty: the mean
    std::vector<SeriesPhoto> photos;
};

SeriesFile read_series(const std::filesystem::path& path, const std::filesystem::path& data)
{
    const json root = base::read_json(path);
    base::Fields fields(root, path.string() + ": ");
    SeriesFile file{data / fields.text("areas", ""), fields.text("series", ""), {}};
    if (!fields.has("areas"))
        fields.fail("areas", "is missing", "name a table of measured areas, as for cicatrix fit");
    const json* days = fields.get("days");
    if (days == nullptr || !days->is_array() || days->size() < 2)
        fields.fail("days", "holds fewer than two days",
                    "give [{\"day\": 0, \"photo\": \"a.png\"}, {\"day\": 3, ...}]");
    for (std::size_t i = 0; i < days->size(); ++i) {
        base::Fields day((*days)[i], fields.where("days") + fmt::format("/{}", i));
        SeriesPhoto photo;
        photo.day = day.number("day", 0, 0, 3650);
        if (!file.photos.empty() && photo.day <= file.photos.back().day)
            day.fail("day", "is not later than the day before it", "give the days in order");
        if (!day.has("photo"))
            day.fail("photo", "is missing", "name a photograph, PNG or JPEG");
        photo.photo = data / day.text("photo", "");
        if (day.has("mask"))
            photo.mask = data / day.text("mask", "");
        if (const json* hints = day.get("segmentation")) {
            if (!photo.mask.empty())
                day.fail("segmentation", "is given together with a mask", "remove one of them");
            photo.hints = scene::read_hints(*hints, day.where("segmentation"));
        }
        day.finish();
        file.photos.push_back(photo);
    }
    fields.finish();
    return file;
}

cv::Mat1b mask_of(const SeriesPhoto& photo, const cv::Mat3b& srgb)
{
    return photo.mask.empty()
               ? wound::segment(srgb, photo.hints, photo.photo.string())
               : wound::checked_mask(base::read_mask(photo.mask), srgb.size(), photo.mask.string());
}

std::optional<double> traced_ratio(const wound::AreaSeries& series, double day)
{
    const auto found = std::ranges::find(series.days, day);
    if (found == series.days.end())
        return std::nullopt;
    return series.ratios[static_cast<std::size_t>(found - series.days.begin())];
}

json or_null(const std::optional<double>& value)
{
    return value ? json(*value) : json(nullptr);
}

cv::Point2d centroid(const cv::Mat1b& mask)
{
    const cv::Moments moments = cv::moments(mask, true);
    return {moments.m10 / moments.m00, moments.m01 / moments.m00};
}

/// Draws the mask's outlines, moved by `shift` pixels of the photograph, on the photograph scaled by `scale`.
void draw_outline(cv::Mat3b& picture, const cv::Mat1b& mask, cv::Point2d shift, double scale,
                  const cv::Scalar& color)
{
    constexpr int subpixel_bits = 4; // sixteenths of a pixel
    std::vector<std::vector<cv::Point>> curves;
    cv::findContours(mask, curves, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
    for (std::vector<cv::Point>& curve : curves)
        for (cv::Point& p : curve)
            p = (cv::Point2d(p) + shift + cv::Point2d(.5, .5)) * scale * (1 << subpixel_bits);
    cv::polylines(picture, curves, true, color, 2, cv::LINE_AA, subpixel_bits);
}

constexpr base::Paint observed_paint = base::palette::white, predicted_paint = base::paint(0x1e50ff);

cv::Mat3b draw_day(const PredictedDay& day, int side)
{
    const double scale = static_cast<double>(side) / std::max(day.srgb.cols, day.srgb.rows);
    cv::Mat3b picture;
    cv::resize(day.srgb, picture, {}, scale, scale, scale < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
    if (day.observed.empty())
        return picture;
    draw_outline(picture, day.observed, {}, scale, base::scalar_of(observed_paint));
    if (day.agreement)
        draw_outline(picture, day.predicted, centroid(day.observed) - centroid(day.predicted), scale,
                     base::scalar_of(predicted_paint));
    return picture;
}

struct Command
{
    std::filesystem::path series, data, out = "out/predict";
};

void run(const Command& command)
{
    const Prediction prediction =
        predict(command.series, command.data.empty() ? command.series.parent_path() : command.data);
    base::make_folder(command.out);
    base::write_json(command.out / "predict.json", to_json(prediction));
    base::write_png(command.out / "predict.png", draw_prediction(prediction));
    fmt::print("{}", to_markdown(prediction));
    for (const PredictedDay& day : prediction.days)
        if (!day.not_found.empty())
            fmt::print("day {:g}: {}\n", day.day, day.not_found);
    fmt::print("predict.json and predict.png in {}\n", command.out.string());
}

} // namespace

Prediction predict(const std::filesystem::path& series, const std::filesystem::path& data)
{
    const SeriesFile file = read_series(series, data);
    Prediction result{wound::fit_from_areas(file.areas, file.series), {}};
    std::optional<wound::PreparedWound> first;
    for (const SeriesPhoto& photo : file.photos) {
        PredictedDay day;
        day.day = photo.day - file.photos.front().day;
        day.photo = photo.photo;
        day.srgb = base::read_rgb(photo.photo);
        day.traced_ratio = traced_ratio(result.fit.series, day.day);
        day.curve_ratio = wound::unhealed_ratio(result.fit.best().curve, day.day);
        if (!first) {
            day.observed = mask_of(photo, day.srgb);
            wound::Preparation preparation;
            preparation.where = photo.photo.string();
            first = wound::prepare({day.srgb, day.observed, {}}, preparation);
        } else
            try {
                day.observed = mask_of(photo, day.srgb);
            } catch (const wound::NoWound& error) {
                day.not_found = error.what();
            }
        day.predicted = wound::predicted_mask(*first, day.curve_ratio);
        if (!day.observed.empty()) {
            day.observed_ratio =
                static_cast<double>(cv::countNonZero(day.observed)) / cv::countNonZero(first->photo_mask);
            if (!result.days.empty() && cv::countNonZero(day.predicted) > 0)
                day.agreement = wound::agreement(day.predicted, day.observed);
        }
        result.days.push_back(std::move(day));
    }
    return result;
}

std::string to_markdown(const Prediction& prediction)
{
    std::string text = "| day | traced area | curve | segmented area | intersection over union | border "
                       "distance, px |\n|---|---|---|---|---|---|\n";
    for (const PredictedDay& day : prediction.days)
        text +=
            fmt::format("| {:g} | {} | {:.2f} | {} | {} | {} |\n", day.day,
                        day.traced_ratio ? fmt::format("{:.2f}", *day.traced_ratio) : "-", day.curve_ratio,
                        day.observed.empty() ? "not found" : fmt::format("{:.2f}", day.observed_ratio),
                        day.agreement ? fmt::format("{:.2f}", day.agreement->intersection_over_union) : "-",
                        day.agreement ? fmt::format("{:.0f}", day.agreement->border_distance_px) : "-");
    return text;
}

json to_json(const Prediction& prediction)
{
    json days = json::array();
    for (const PredictedDay& day : prediction.days) {
        json entry{{"day", day.day},
                   {"photo", day.photo.string()},
                   {"traced_ratio", or_null(day.traced_ratio)},
                   {"curve_ratio", day.curve_ratio},
                   {"segmented_ratio", nullptr},
                   {"intersection_over_union", nullptr},
                   {"border_distance_px", nullptr}};
        if (!day.observed.empty())
            entry["segmented_ratio"] = day.observed_ratio;
        else
            entry["not_found"] = day.not_found;
        if (day.agreement) {
            entry["intersection_over_union"] = day.agreement->intersection_over_union;
            entry["border_distance_px"] = day.agreement->border_distance_px;
        }
        days.push_back(entry);
    }
    json fit = wound::fit_to_json({prediction.fit});
    return {{"fit", fit.at("series").at(0)}, {"days", days}};
}

cv::Mat3b draw_prediction(const Prediction& prediction)
{
    constexpr int column_count = 8, map_side = 200, gap_px = 6, title_height = 22; // pixels
    const int count = static_cast<int>(prediction.days.size());
    const int columns = std::min(count, column_count), rows = (count + columns - 1) / columns;
    cv::Mat3b page(title_height + rows * (map_side + title_height + gap_px),
                   gap_px + columns * (map_side + gap_px), base::rgb_of(base::palette::white));
    base::draw_text(page, "white: seen", {gap_px, 16}, {base::palette::faint});
    base::draw_text(page, "blue: predicted", {gap_px + 110, 16}, {predicted_paint});
    for (int i = 0; i < count; ++i) {
        const PredictedDay& day = prediction.days[static_cast<std::size_t>(i)];
        const cv::Point at(gap_px + i % columns * (map_side + gap_px),
                           2 * title_height + i / columns * (map_side + title_height + gap_px));
        const cv::Mat3b picture = draw_day(day, map_side);
        picture.copyTo(page(cv::Rect(at, picture.size())));
        std::string title = fmt::format("day {:g}", day.day);
        if (day.agreement)
            title += fmt::format(", overlap {:.2f}", day.agreement->intersection_over_union);
        else if (day.observed.empty())
            title += ", not found";
        base::draw_text(page, title, {at.x, at.y - 6});
    }
    return page;
}

void add(CLI::App& program)
{
    auto options = std::make_shared<Command>();
    CLI::App* command = program.add_subcommand(
        "predict", "Predict a wound from its first photograph and compare with later photographs");
    command
        ->add_option("series", options->series,
                     "File that names days, photographs and the table of measured areas")
        ->required()
        ->type_name("SERIES.json");
    command
        ->add_option("--data", options->data,
                     "Folder of the files named in SERIES.json (default: the folder of SERIES.json)")
        ->type_name("DIR");
    command->add_option("--out", options->out, "Folder for predict.json and predict.png")
        ->capture_default_str()
        ->type_name("DIR");
    command->footer(
        "Example: cicatrix predict series.json --out predict\n\n"
        "  {\"areas\": \"areas.csv\", \"series\": \"old-1\", \"days\": [\n"
        "    {\"day\": 0, \"photo\": \"day0.png\", \"segmentation\": {\"rect\": [120, 80, 300, 260]}},\n"
        "    {\"day\": 3, \"photo\": \"day3.png\", \"mask\": \"mask3.png\"}]}");
    command->callback([options] { run(*options); });
}

} // namespace predict_command
