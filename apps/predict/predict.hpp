// `cicatrix predict SERIES.json`: a wound photographed on several days, predicted from the first photograph
// and its measured areas, and compared with what each later photograph shows (wound/agreement.hpp).
#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "wound/healing/fit.hpp"
#include "wound/photo/agreement.hpp"

namespace CLI {
class App;
}

namespace predict_command {

struct PredictedDay
{
    double day = 0; // since the first photograph
    std::filesystem::path photo;
    cv::Mat3b srgb;
    cv::Mat1b observed, predicted;      // 255 in the wound; observed is empty where none was found
    std::string not_found;              // then why
    std::optional<double> traced_ratio; // of the area on the first day: measured
    double curve_ratio = 1;             // of the curve fitted to what was measured
    double observed_ratio = 0;          // of pixels
    std::optional<wound::ContourAgreement> agreement; // on later days with a wound in both masks
};

struct Prediction
{
    wound::SeriesFit fit;
    std::vector<PredictedDay> days;
};

/// Files named in `series` are relative to `data`. Throws base::InputError for a broken file and where
/// the first photograph shows no wound.
Prediction predict(const std::filesystem::path& series, const std::filesystem::path& data);

std::string to_markdown(const Prediction& prediction);
nlohmann::json to_json(const Prediction& prediction);
/// RGB. Every photograph with the observed outline and, laid on its centroid, the predicted one.
cv::Mat3b draw_prediction(const Prediction& prediction);

void add(CLI::App& program);

} // namespace predict_command
