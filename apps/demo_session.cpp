#include "apps/demo_session.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace app {

double now_s()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void Playback::toggle()
{
    playing = !playing;
    if (playing && day >= last_day)
        day = 0;
}

void Playback::advance(double seconds)
{
    if (!playing)
        return;
    seek(day + seconds * days_per_second);
    if (day >= last_day)
        playing = false;
}

void Playback::seek(double to)
{
    day = std::clamp(to, 0.0, last_day);
}

void Quality::rendered(double scale, double ms)
{
    rendered_scale_ = scale;
    // Cost grows with the number of pixels, less so when the picture is small.
    const double full_ms = ms / std::pow(scale, 1.5);
    constexpr std::array steps{1.0, .75, .5, .35, .25};
    const double fitting = std::pow(wanted_ms / std::max(full_ms, 1e-3), 1 / 1.5);
    const auto step = std::ranges::find_if(steps, [&](double s) { return s <= fitting; });
    const double next = step == steps.end() ? steps.back() : *step;
    // A change of size makes images anew: up only when there is room to spare.
    if (next < moving_scale_ || next > 1.2 * moving_scale_)
        moving_scale_ = next;
}

std::optional<double> Quality::due_in(double now) const
{
    if (rendered_scale_ >= 1)
        return std::nullopt;
    return std::max(0.0, moving_until_ - now);
}

void Notices::drop_old(double now)
{
    std::erase_if(list_, [&](const Notice& notice) { return !notice.error && notice.until <= now; });
}

std::optional<double> Notices::next_change() const
{
    std::optional<double> next;
    for (const Notice& notice : list_)
        if (!notice.error)
            next = std::min(next.value_or(notice.until), notice.until);
    return next;
}

} // namespace app
