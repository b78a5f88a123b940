#include "wound/optics/spectrum.hpp"

#include <cassert>
#include <cmath>
#include <vector>

namespace optics {

namespace {

// CIE 15: colour-matching functions of the 1931 standard observer and D65, every 10 nm from 400 nm.
struct Observed
{
    double x, y, z, d65;
};
constexpr std::array<Observed, wavelength_count> cie{{
    {.01431, .000396, .06785, 82.7549}, {.04351, .00121, .2074, 91.486},    {.13438, .004, .6456, 93.4318},
    {.2839, .0116, 1.3856, 86.6823},    {.34828, .023, 1.74706, 104.865},   {.3362, .038, 1.77211, 117.008},
    {.2908, .06, 1.6692, 117.812},      {.19536, .09098, 1.28764, 114.861}, {.09564, .13902, .81295, 115.923},
    {.03201, .20802, .46518, 108.811},  {.0049, .323, .272, 109.354},       {.0093, .503, .1582, 107.802},
    {.06327, .71, .07825, 104.79},      {.1655, .862, .04216, 107.689},     {.2904, .954, .0203, 104.405},
    {.43345, .99495, .00875, 104.046},  {.5945, .995, .0039, 100},          {.7621, .952, .0021, 96.3342},
    {.9163, .87, .00165, 95.788},       {1.0263, .757, .0011, 88.6856},     {1.0622, .631, .0008, 90.0062},
    {1.0026, .503, .00034, 89.5991},    {.85445, .381, .00019, 87.6987},    {.6424, .265, .00005, 83.2886},
    {.4479, .175, .00002, 83.6992},     {.2835, .107, 0, 80.0268},          {.1649, .061, 0, 80.2146},
    {.0874, .032, 0, 82.2778},          {.04677, .017, 0, 78.2842},         {.0227, .00821, 0, 69.7213},
    {.011359, .004102, 0, 71.6091},
}};

// IEC 61966-2-1: XYZ (D65) to linear Rec. 709.
const cv::Matx33d rgb_from_xyz(3.2406, -1.5372, -.4986, -.9689, 1.8758, .0415, .0557, -.2040, 1.0570);

std::vector<base::Color> spectral_weights()
{
    std::vector<base::Color> weights;
    base::Color sum(0, 0, 0);
    for (const Observed& o : cie) {
        weights.push_back(rgb_from_xyz * (o.d65 * base::Color(o.x, o.y, o.z)));
        sum += weights.back();
    }
    for (base::Color& w : weights)
        for (int c = 0; c < 3; ++c)
            w[c] /= sum[c]; // a white reflector is (1,1,1) exactly
    return weights;
}

} // namespace

std::span<const base::Color> channel_weights(std::size_t channels)
{
    static const std::vector<base::Color> grey = {{1, 1, 1}}, rgb = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                          spectral = spectral_weights();
    return channels == 1                  ? grey
           : channels == 3                ? rgb
           : channels == wavelength_count ? spectral
                                          : std::span<const base::Color>{};
}

base::Color linear_rgb(std::span<const double> channels)
{
    const std::span<const base::Color> weights = channel_weights(channels.size());
    assert(weights.size() == channels.size());
    base::Color color(0, 0, 0);
    for (std::size_t i = 0; i < channels.size(); ++i)
        color += channels[i] * weights[i];
    return color;
}

base::Lab lab_10_degrees(const Spectrum& reflectance)
{
    // Wyman, Sloan & Shirley 2013, "Simple analytic approximations to the CIE XYZ color matching functions":
    // single lobes of the 1964 observer. They give D65 the chromaticity (.3137, .3309); the tables give
    // (.3138, .3310).
    double xyz[3] = {}, white[3] = {};
    for (std::size_t i = 0; i < wavelength_count; ++i) {
        const double nm = wavelength_nm(i), d65 = cie[i].d65;
        const auto square = [](double v) { return v * v; };
        const double observer[3] = {.398 * std::exp(-1250 * square(std::log((nm + 570.1) / 1014))) +
                                        1.132 * std::exp(-234 * square(std::log((1338 - nm) / 743.5))),
                                    1.011 * std::exp(-.5 * square((nm - 556.1) / 46.14)),
                                    2.060 * std::exp(-32 * square(std::log((nm - 265.8) / 180.4)))};
        for (int c = 0; c < 3; ++c) {
            white[c] += observer[c] * d65;
            xyz[c] += observer[c] * d65 * reflectance[i];
        }
    }
    double f[3];
    for (int c = 0; c < 3; ++c) {
        const double t = xyz[c] / white[c];
        f[c] = t > 216. / 24389 ? std::cbrt(t) : (24389. / 27 * t + 16) / 116;
    }
    return {116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])};
}

} // namespace optics
