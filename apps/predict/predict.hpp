// `cicatrix predict SERIES.json`: predicts a wound from its first photograph and its measured areas, and
// compares the prediction with each later photograph (wound/photo/agreement.hpp).
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
    cv::Mat1b observed, predicted;      // 255 in the wound; `observed` is empty when none was found
    std::string not_found;              // the reason when `observed` is empty
    std::optional<double> traced_ratio; // measured area / area on day 0, if the table has this day
    double curve_ratio = 1;             // area / area on day 0 by the fitted curve
    double observed_ratio = 0;          // pixels in `observed` / pixels in the first mask
    std::optional<wound::ContourAgreement> agreement; // on later days, if both masks have a wound
};

struct Prediction
{
    wound::SeriesFit fit;
    std::vector<PredictedDay> days;
};

/// Files named in `series` are relative to the folder `data`. Throws base::InputError for an invalid file and
/// when no wound is found in the first photograph.
Prediction predict(const std::filesystem::path& series, const std::filesystem::path& data);

std::string to_markdown(const Prediction& prediction);
nlohmann::json to_json(const Prediction& prediction);
/// RGB. Every photograph with the observed outline and the predicted one, moved to the observed centroid.
cv::Mat3b draw_prediction(const Prediction& prediction);

void add(CLI::App& program);

} // namespace predict_command
