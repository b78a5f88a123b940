#include "base/color.hpp"

#include <cmath>
#include <gtest/gtest.h>

using base::Lab;

namespace {

struct SharmaPair
{
    Lab x, y;
    double delta_e;
};

// Sharma, Wu & Dalal 2005, table 1: all 34 pairs.
const SharmaPair sharma_table[] = {
    {{50.0000, 2.6772, -79.7751}, {50.0000, 0.0000, -82.7485}, 2.0425},
    {{50.0000, 3.1571, -77.2803}, {50.0000, 0.0000, -82.7485}, 2.8615},
    {{50.0000, 2.8361, -74.0200}, {50.0000, 0.0000, -82.7485}, 3.4412},
    {{50.0000, -1.3802, -84.2814}, {50.0000, 0.0000, -82.7485}, 1.0000},
    {{50.0000, -1.1848, -84.8006}, {50.0000, 0.0000, -82.7485}, 1.0000},
    {{50.0000, -0.9009, -85.5211}, {50.0000, 0.0000, -82.7485}, 1.0000},
    {{50.0000, 0.0000, 0.0000}, {50.0000, -1.0000, 2.0000}, 2.3669},
    {{50.0000, -1.0000, 2.0000}, {50.0000, 0.0000, 0.0000}, 2.3669},
    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0009}, 7.1792},
    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0010}, 7.1792},
    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0011}, 7.2195},
    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0012}, 7.2195},
    {{50.0000, -0.0010, 2.4900}, {50.0000, 0.0009, -2.4900}, 4.8045},
    {{50.0000, -0.0010, 2.4900}, {50.0000, 0.0010, -2.4900}, 4.8045},
    {{50.0000, -0.0010, 2.4900}, {50.0000, 0.0011, -2.4900}, 4.7461},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 0.0000, -2.5000}, 4.3065},
    {{50.0000, 2.5000, 0.0000}, {73.0000, 25.0000, -18.0000}, 27.1492},
    {{50.0000, 2.5000, 0.0000}, {61.0000, -5.0000, 29.0000}, 22.8977},
    {{50.0000, 2.5000, 0.0000}, {56.0000, -27.0000, -3.0000}, 31.9030},
    {{50.0000, 2.5000, 0.0000}, {58.0000, 24.0000, 15.0000}, 19.4535},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 3.1736, 0.5854}, 1.0000},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 3.2972, 0.0000}, 1.0000},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 1.8634, 0.5757}, 1.0000},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 3.2592, 0.3350}, 1.0000},
    {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
    {{63.0109, -31.0961, -5.8663}, {62.8187, -29.7946, -4.0864}, 1.2630},
    {{61.2901, 3.7196, -5.3901}, {61.4292, 2.2480, -4.9620}, 1.8731},
    {{35.0831, -44.1164, 3.7933}, {35.0232, -40.0716, 1.5901}, 1.8645},
    {{22.7233, 20.0904, -46.6940}, {23.0331, 14.9730, -42.5619}, 2.0373},
    {{36.4612, 47.8580, 18.3852}, {36.2715, 50.5065, 21.2231}, 1.4146},
    {{90.8027, -2.0831, 1.4410}, {91.1528, -1.6435, 0.0447}, 1.4441},
    {{90.9257, -0.5406, -0.9208}, {88.6381, -0.8985, -0.7239}, 1.5381},
    {{6.7747, -0.2908, -2.4247}, {5.8714, -0.0985, -2.2286}, 0.6377},
    {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082},
};

} // namespace

TEST(Color, DeltaE2000MatchesSharmasTable)
{
    for (const auto& pair : sharma_table) {
        EXPECT_NEAR(base::delta_e2000(pair.x, pair.y), pair.delta_e, 5e-5) << pair.x.a << ' ' << pair.x.b;
        EXPECT_NEAR(base::delta_e2000(pair.y, pair.x), pair.delta_e, 5e-5) << pair.x.a << ' ' << pair.x.b;
    }
}

TEST(Color, SrgbIsContinuousAndInvertible)
{
    EXPECT_EQ(base::srgb_from_linear(0), 0);
    EXPECT_NEAR(base::srgb_from_linear(1), 1, 1e-15);
    EXPECT_NEAR(base::srgb_from_linear(0.0031308), base::srgb_from_linear(0.0031308 + 1e-12), 1e-7);
    EXPECT_NEAR(base::srgb_from_linear(0.18), 0.46135612950044, 1e-12); // mid grey
    for (double x = 0; x <= 1; x += 1.0 / 1024)
        EXPECT_NEAR(base::linear_from_srgb(base::srgb_from_linear(x)), x, 1e-7) << x;
    for (int code = 0; code < 256; ++code) {
        const cv::Vec3b rgb = cv::Vec3b::all(static_cast<uchar>(code));
        EXPECT_EQ(base::srgb8_from_linear(base::linear_from_srgb8(rgb)), rgb);
    }
}

TEST(Color, EightBitEncodingClamps)
{
    EXPECT_EQ(base::srgb8_from_linear({-1, 2, 1e300}), cv::Vec3b(0, 255, 255));
    EXPECT_EQ(base::srgb8_from_linear({NAN, INFINITY, -INFINITY}), cv::Vec3b(0, 255, 0));
}

// CIELAB of the sRGB primaries under D65 as commonly tabulated (Lindbloom).
TEST(Color, LabOfKnownColors)
{
    const Lab white = base::lab_from_linear(base::Color(1, 1, 1));
    EXPECT_NEAR(white.l, 100, 1e-9);
    EXPECT_NEAR(white.a, 0, 1e-9);
    EXPECT_NEAR(white.b, 0, 1e-9);
    const Lab red = base::lab_from_linear(base::Color(1, 0, 0));
    EXPECT_NEAR(red.l, 53.24, 0.01);
    EXPECT_NEAR(red.a, 80.09, 0.01);
    EXPECT_NEAR(red.b, 67.20, 0.01);
    const Lab black = base::lab_from_linear(base::Color(0, 0, 0));
    EXPECT_NEAR(black.l, 0, 1e-12);
}

TEST(Color, LabAndBackIsTheSameColor)
{
    for (const base::Color& color :
         {base::Color(0, 0, 0), base::Color(0.6, 0.3, 0.2), base::Color(0.001, 0, 0.002)})
        EXPECT_LT(cv::norm(base::linear_from_lab(base::lab_from_linear(color)) - color), 1e-12);
}
