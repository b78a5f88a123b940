// State of the demo that does not depend on drawing: timeline, playback, notices, and the render size while
// something moves. No Dear ImGui, no Vulkan.
#pragma once
#include <chrono>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace demo_command {

/// Seconds on a steady clock.
double now_s();

/// Maps days to the timeline: linear while the wound is open, then logarithmic for the scar's months.
class TimelineAxis
{
  public:
    /// `closure_day`: infinite for a wound that never closes.
    explicit TimelineAxis(double closure_day, double least_days = 30);
    TimelineAxis() : TimelineAxis(30) {}

    double day_at(double fraction) const; // `fraction` of the axis, 0..1
    double fraction_of(double day) const; // the inverse
    double last_day() const { return last_day_; }
    double closure_day() const { return closure_day_; }
    /// Day at which the scale changes from linear to logarithmic.
    double even_until() const { return even_days_; }

    struct Tick
    {
        double day;
        std::string label;
    };
    /// Tick labels in days and, for the scar, months; `most`: about the largest number of labels.
    std::vector<Tick> ticks(std::size_t most) const;
    bool operator==(const TimelineAxis&) const = default;

  private:
    double closure_day_, even_days_, last_day_, even_share_;
};

/// Playback of the days.
struct Playback
{
    TimelineAxis axis;
    double day = 0;
    double days_per_second = 3; // while the wound is open; the marker keeps its speed along the axis later
    bool playing = false;

    /// Starts from day 0 when the marker is at the end.
    void toggle();
    /// Stops at the last day.
    void advance(double seconds);
    void seek(double to);
};

/// Chooses the render scale: reduced while something moves, to keep the frame rate, and full once at rest.
class Quality
{
  public:
    /// Reports that a picture was rendered at `scale` (1: full size) in `ms`.
    void rendered(double scale, double ms);
    /// Reports that something moves at time `now` (s).
    void moving(double now) { moving_until_ = now + calm_s; }
    /// The scale to render at: 0.25..1.
    double scale(double now) const { return now < moving_until_ ? moving_scale_ : 1; }
    /// Seconds until the full picture is due; none when the last picture was full.
    std::optional<double> due_in(double now) const;

  private:
    static constexpr double calm_s = .15, wanted_ms = 40;
    double moving_scale_ = 1, moving_until_ = -1, rendered_scale_ = 1;
};

/// A message for the user. Errors stay until dismissed, others disappear at the time `until` (s).
struct Notice
{
    std::string text;
    bool error = false;
    double until = 0;
};

class Notices
{
  public:
    void say(const std::string& text, double now) { add({text, false, now + 6}); }
    void fail(const std::string& text) { add({text, true, 0}); }
    void drop_old(double now);
    void dismiss(std::size_t index) { list_.erase(list_.begin() + std::ptrdiff_t(index)); }
    /// When the next notice disappears; none: never.
    std::optional<double> next_change() const;
    const std::deque<Notice>& list() const { return list_; }

  private:
    void add(Notice notice); // at the end; removes an earlier notice with the same text

    std::deque<Notice> list_;
};

} // namespace demo_command
