// Photographs of one or more generated wounds, for tests: on skin that fills the picture or on a limb in
// front of a background, in uneven light, with noise and a known mask.
#pragma once
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <random>
#include <vector>

#include "wound/synthetic/synthetic.hpp"

namespace testing_wounds {

struct PlacedWound
{
    wound::SyntheticWound wound;
    cv::Point at; // centre in the picture, pixels
    int side = 0; // of the generated picture, pixels
    cv::Vec3d tint{1, 1, 1};
};

struct Setting
{
    cv::Size size{640, 480};
    cv::Vec3b skin{212, 164, 140};
    std::optional<cv::Vec3b> background; // if set, the skin is a limb in front of it
    double slant = .2;                   // of the limb's axis from the vertical, px per px
    double shading = .3;                 // relative fall of light across the picture
    double noise = 4;
};

inline wound::Photograph compose(const Setting& setting, std::vector<PlacedWound> wounds)
{
    const cv::Size size = setting.size;
    cv::Mat3f color(size, cv::Vec3f(setting.skin));
    wound::Photograph result{cv::Mat3b(size), cv::Mat1b::zeros(size), {}};
    for (PlacedWound& placed : wounds) {
        placed.wound.skin = setting.skin;
        const wound::Photograph one = wound::synthesize(placed.wound);
        cv::Mat3b small;
        cv::Mat1b mask;
        cv::resize(one.srgb, small, {placed.side, placed.side}, 0, 0, cv::INTER_AREA);
        cv::resize(one.mask, mask, small.size(), 0, 0, cv::INTER_AREA);
        const double half = .5 * placed.side;
        for (int y = 0; y < placed.side; ++y)
            for (int x = 0; x < placed.side; ++x) {
                const cv::Point p(placed.at.x + x - int(half), placed.at.y + y - int(half));
                if (!cv::Rect(cv::Point(), size).contains(p))
                    continue;
                const double off = std::hypot(x - half, y - half) / half;
                const float share = float(std::clamp((1 - off) / .2, 0., 1.));
                cv::Vec3f there = small(y, x);
                if (mask(y, x) > 127)
                    there = cv::Vec3f(cv::Vec3d(there).mul(placed.tint));
                color(p) = color(p) * (1 - share) + there * share;
                if (mask(y, x) > 127)
                    result.mask(p) = 255;
            }
    }
    std::mt19937 random(5);
    std::normal_distribution<double> noise(0, setting.noise);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const double across = double(x) / size.width + .5 * double(y) / size.height;
            double light = 1 + setting.shading * (.6 - across);
            cv::Vec3d at = color(y, x);
            if (setting.background) {
                const double middle = .5 * size.width + setting.slant * (y - .5 * size.height);
                const double u = (x - middle) / (.3 * size.width);
                if (std::abs(u) < 1)
                    light *= .45 + .55 * std::sqrt(1 - u * u);
                else {
                    at = cv::Vec3d(*setting.background);
                    result.mask(y, x) = 0;
                }
            }
            for (int c = 0; c < 3; ++c)
                result.srgb(y, x)[c] = cv::saturate_cast<uchar>(at[c] * light + noise(random));
        }
    return result;
}

} // namespace testing_wounds
