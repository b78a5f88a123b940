// The generated wound's tissue at each point: reflectance, relief and wetness of skin, open bed, fibrin,
// clot, crust. Colours are linear Rec. 709 reflectances; red comes from layers of blood over pale tissue
// (Beer-Lambert), so the colours of film, inflamed halo, granulation and clot are related, as in real tissue.
#pragma once
#include "wound/synthetic/noise.hpp"
#include "wound/synthetic/synthetic.hpp"

namespace wound {

/// One point of the surface.
struct Tissue
{
    cv::Vec3f reflectance; // linear
    float height_mm = 0;   // above the surrounding healthy skin
    float wetness = 0;     // 0 dry .. 1 a film of serum
};

/// Noise fields whose features span millimetres; computed on a coarse grid to save time.
enum SlowField
{
    Blotches,
    Uneven,
    Mottled,
    Bruise,
    Scraped,
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
    cv::Point2f p;      // mm from the picture's middle
    float inside_mm;    // signed distance to the outline, positive in the open bed
    float facing_light; // whether the wall that descends from the outline faces the light (1) or faces away
                        // from it (-1)
    SlowFields slow;
};

class TissuePainter
{
  public:
    TissuePainter(const SyntheticWound& wound, const Noise& noise);

    /// The slow fields at a point that is `inside_mm` within the outline.
    SlowFields slow_fields(cv::Point2f p, float inside_mm) const;

    /// Sets the thresholds that give clot and fibrin their shares of the open bed. `bed`: the slow fields at
    /// evenly spread points of the bed.
    void set_shares(const std::vector<SlowFields>& bed);

    Tissue at(const Place& place) const;

  private:
    Tissue skin(const Place& place) const;
    Tissue bed(const Place& place) const;
    void inflame(Tissue& tissue, const Place& place) const;
    void scrape(Tissue& tissue, const Place& place) const;
    void smear_blood(Tissue& tissue, const Place& place) const;
    void fray_border(Tissue& tissue, const Place& place) const;
    void lay_fibrin(Tissue& tissue, const Place& place, float bump) const;
    void lay_clot(Tissue& tissue, const Place& place) const;
    cv::Point2f channel_position(cv::Point2f p, float per_mm, int channel) const;
    float noise(cv::Point2f p, float per_mm, int channel, int octaves = 1) const;

    SyntheticWound wound_;
    const Noise& noise_;
    cv::Vec3f skin_; // linear
    float fibrin_threshold_ = 0, clot_threshold_ = 0;
    cv::Point2f scrape_direction_, scrape_centre_;
    std::array<cv::Point2f, 96> turns_; // cosine and sine of the rotation of each channel's lattice
};

} // namespace wound
