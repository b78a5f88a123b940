#include "wound/wound.hpp"
#include "wound/contour.hpp"
#include "wound/color.hpp"
#include <opencv2/imgproc.hpp>
namespace wound {
PreparedWound prepare(const Photograph& ph, const Preparation& pr, std::string_view)
{
    cv::Rect box = cv::boundingRect(ph.mask);
    double side = std::max(box.width, box.height) / .45;
    cv::Moments m = cv::moments(ph.mask, true);
    double cx = m.m10 / m.m00, cy = m.m01 / m.m00;
    int n = 512; double s = side / n;
    cv::Matx23d A(s, 0, cx - side / 2, 0, s, cy - side / 2);
    cv::Mat3b rgb; cv::warpAffine(ph.srgb, rgb, A, {n, n}, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
    cv::Mat1b mk; cv::warpAffine(ph.mask, mk, A, {n, n}, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
    PreparedWound w;
    w.patch.color.create(n, n); w.patch.mask.create(n, n); w.patch.depth_mm.create(n, n); w.patch.opacity = cv::Mat1f(n, n, 1.f);
    for (int y = 0; y < n; y++) for (int x = 0; x < n; x++) { for (int k = 0; k < 3; k++) w.patch.color(y, x)[k] = srgb_to_linear(rgb(y, x)[k] / 255.f); w.patch.mask(y, x) = mk(y, x) / 255.f; }
    cv::Mat1f d; cv::distanceTransform(mk > 127, d, cv::DIST_L2, 5);
    for (int y = 0; y < n; y++) for (int x = 0; x < n; x++) w.patch.depth_mm(y, x) = float(pr.depth_factor * 2.0 * (1 - std::exp(-d(y, x) / 10)));
    w.patch.width_mm = pr.width_mm / .45;
    w.border = border_of(w.patch.mask);
    w.control_points = control_points(w.border, {0, 0}, spacing_from_curvature(w.border, {0, 0}));
    w.flow = prepare_flow(w.border, w.control_points, {0, 0});
    return w;
}
WoundDay wound_at(const PreparedWound& w, const Healing& h, double day)
{
    HealingState s = healing_at(h, day);
    WoundDay d; d.day = day; d.unhealed_ratio = s.unhealed_ratio; d.border_ratio = s.border_ratio; d.recovery_ratio = s.recovery_ratio; d.depth_scale = s.depth_scale;
    d.border_warp = make_warp(w.flow, s.border_ratio); d.bed_warp = make_warp(w.flow, s.unhealed_ratio);
    return d;
}
}
