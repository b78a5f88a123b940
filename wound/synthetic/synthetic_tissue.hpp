// The generated wound's tissue at each point: reflectance, depth, relief and wetness of skin, cut dermis and
// fat, granulation, fibrin, clot. Colours are linear Rec. 709 reflectances; red comes from layers of blood
// over pale tissue (Beer-Lambert), so the colours of film, inflamed halo, granulation and clot are related,
// as in real tissue. The kinds' files compose their beds of these parts.
#pragma once
#include <array>

#include "wound/synthetic/kind.hpp"
#include "wound/synthetic/noise.hpp"
#include "wound/synthetic/synthetic.hpp"

namespace wound {

/// One point of the surface.
struct Tissue
{
    cv::Vec3f reflectance; // linear
    float layer = 0;       // how deep, see Photograph::layer
    float height_mm = 0;   // fine relief, which the picture's own light shows; part of `layer`, too
    float wetness = 0;     // 0 dry .. 1 a film of serum
};

/// Adds relief, mm upwards.
void raise(Tissue& tissue, float mm);

cv::Vec3f mix(const cv::Vec3f& a, const cv::Vec3f& b, float t);
/// Reflectance of `base` under `amount` units of blood, of one of these absorbances.
cv::Vec3f through(const cv::Vec3f& base, const cv::Vec3f& blood, float amount);

// Absorbance of one unit of blood per channel: haemoglobin absorbs green and blue and almost no red; without
// oxygen, or dried to methaemoglobin, it absorbs more red. Shapes after Prahl's haemoglobin tables averaged
// over the sRGB primaries.
inline const cv::Vec3f oxygenated{.16f, 1.f, .90f}, deoxygenated{.38f, 1.f, .82f}, dried{.80f, 1.05f, .95f};
inline const cv::Vec3f pale_dermis{.74f, .53f, .43f};

/// Direction of an abrasion's streaks, radians from x towards y.
float scrape_angle(std::uint32_t seed);

/// Noise fields whose features span millimetres; computed on a coarse grid to save time.
enum SlowField
{
    Blotches,
    Uneven,
    Mottled,
    Bruise,
    Wiped,
    FilmPatches,
    Stretch,
    Supply,
    Livid,
    Wall,
    Floor,
    Knobby,
    Fibrin,
    Clot,
    BendX,
    BendY,
    SlowFieldCount
};
using SlowFields = cv::Vec<float, SlowFieldCount>;

/// A point and its position relative to the outline.
struct Place
{
    cv::Point2f p;   // mm from the picture's middle
    float inside_mm; // signed distance to the outline, positive in the open bed
    SlowFields slow;
};

class TissuePainter
{
  public:
    TissuePainter(const WoundKind& kind, const SyntheticWound& wound, const Noise& noise);

    /// The slow fields at a point that is `inside_mm` within the outline.
    SlowFields slow_fields(cv::Point2f p, float inside_mm) const;

    /// Sets the thresholds that give clot and fibrin their shares of the open bed. `bed`: the slow fields at
    /// evenly spread points of the bed.
    void set_shares(const std::vector<SlowFields>& bed);

    Tissue at(const Place& place) const;

    // ---- For the kinds' files
    std::uint32_t seed() const { return wound_.seed; }
    /// Noise of about -1..1 whose features are 1 / per_mm wide; each use has its own `channel`, 0..95.
    float noise(cv::Point2f p, float per_mm, int channel, int octaves = 1) const;
    /// Streaks along the scrape, about -1..1.
    float streaks(const Place& place) const;
    /// Healthy skin: blotches of blood, and pores.
    Tissue skin(const Place& place) const;
    /// A fresh cut whose wall falls to layer `floor` within about `wall_mm` of the border: pale to red dermis
    /// on the wall, below it red tissue with lobules of fat. `fat`: their share, 0..1.
    Tissue cut(const Place& place, float floor, float wall_mm, float fat) const;
    /// Granulating tissue without depth: knobs of young vessels in pale tissue, darker clefts between them;
    /// livid where oxygen is low.
    Tissue granulation(const Place& place) const;
    /// Yellow slough: a translucent film that fills the clefts before it covers the knobs; a few strands at
    /// its margin.
    void lay_fibrin(Tissue& tissue, const Place& place) const;
    /// Clotted blood: brown-black, lumpy and partly cracked where thick, with a translucent dark red film
    /// around it.
    void lay_clot(Tissue& tissue, const Place& place) const;

  private:
    Tissue fat_lobules(const Place& place) const;
    void inflame(Tissue& tissue, const Place& place) const;
    void smear_blood(Tissue& tissue, const Place& place) const;
    cv::Point2f channel_position(cv::Point2f p, float per_mm, int channel) const;

    const WoundKind& kind_;
    SyntheticWound wound_;
    const Noise& noise_;
    cv::Vec3f skin_; // linear
    float fibrin_threshold_ = 0, clot_threshold_ = 0;
    cv::Point2f scrape_direction_;
    std::array<cv::Point2f, 96> turns_; // cosine and sine of the rotation of each channel's lattice
};

} // namespace wound
