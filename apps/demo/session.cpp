#include "apps/demo/session.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace demo_command {
namespace {

constexpr double scar_days = 366, days_per_month = 30.4; // the timeline shows the scar for a year

} // namespace

double now_s()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

TimelineAxis::TimelineAxis(double closure_day, double least_days)
    : closure_day_(closure_day), even_days_(std::max(least_days, 1.0))
{
    const bool closes = std::isfinite(closure_day) && closure_day < 3650 - scar_days;
    if (closes)
        even_days_ = std::max(even_days_, std::ceil(1.1 * closure_day));
    last_day_ = closes ? std::max(even_days_, std::ceil(closure_day + scar_days)) : even_days_;
    even_share_ = last_day_ > even_days_ ? .62 : 1;
}

double TimelineAxis::day_at(double fraction) const
{
    const double at = std::clamp(fraction, 0.0, 1.0);
    if (at <= even_share_)
        return at / even_share_ * even_days_;
    return even_days_ * std::pow(last_day_ / even_days_, (at - even_share_) / (1 - even_share_));
}

double TimelineAxis::fraction_of(double day) const
{
    const double at = std::clamp(day, 0.0, last_day_);
    if (at <= even_days_)
        return at / even_days_ * even_share_;
    return even_share_ + (1 - even_share_) * std::log(at / even_days_) / std::log(last_day_ / even_days_);
}

std::vector<TimelineAxis::Tick> TimelineAxis::ticks(std::size_t most) const
{
    std::vector<Tick> ticks;
    const auto room = double(std::max<std::size_t>(most, 4)) * even_share_;
    double step = 1;
    for (const double wider : {1.0, 2.0, 5.0, 7.0, 14.0, 28.0, 56.0, 112.0, 365.0})
        if (even_days_ / (step = wider) <= room)
            break;
    for (double day = 0; day <= even_days_; day += step)
        ticks.push_back({day, fmt::format("{:g}", day)});
    if (last_day_ <= even_days_)
        return ticks;
    for (const int months : {1, 2, 3, 6, 12}) {
        const double day = closure_day_ + months * days_per_month;
        if (day > even_days_ * 1.15)
            ticks.push_back({day, fmt::format("+{} mo", months)});
    }
    return ticks;
}

void Playback::toggle()
{
    playing = !playing;
    if (playing && day >= axis.last_day())
        day = 0;
}

void Playback::advance(double seconds)
{
    if (!playing)
        return;
    const double per_second = axis.fraction_of(axis.even_until()) / axis.even_until() * days_per_second;
    const double fraction = axis.fraction_of(day) + seconds * per_second;
    day = axis.day_at(fraction);
    if (fraction >= 1)
        playing = false;
}

void Playback::seek(double to)
{
    day = std::clamp(to, 0.0, axis.last_day());
}

void Quality::rendered(double scale, double ms)
{
    rendered_scale_ = scale;
    // Cost grows with the number of pixels, but less for small pictures: about as scale^1.5.
    const double full_ms = ms / std::pow(scale, 1.5);
    constexpr std::array steps{1.0, .75, .5, .35, .25};
    const double fitting = std::pow(wanted_ms / std::max(full_ms, 1e-3), 1 / 1.5);
    const auto step = std::ranges::find_if(steps, [&](double s) { return s <= fitting; });
    const double next = step == steps.end() ? steps.back() : *step;
    // A new size needs new images, so enlarge only by more than 20 %.
    if (next < moving_scale_ || next > 1.2 * moving_scale_)
        moving_scale_ = next;
}

std::optional<double> Quality::due_in(double now) const
{
    if (rendered_scale_ >= 1)
        return std::nullopt;
    return std::max(0.0, moving_until_ - now);
}

void Notices::add(Notice notice)
{
    std::erase_if(list_, [&](const Notice& earlier) { return earlier.text == notice.text; });
    list_.push_back(std::move(notice));
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

} // namespace demo_command
