// What the demo's user is doing, apart from how it is drawn: the day and whether time runs, what is selected,
// messages, and at which size to render while something moves. No Dear ImGui, no Vulkan.
#pragma once
#include <chrono>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace demo_command {

/// Seconds on a steady clock.
double now_s();

/// Days along the timeline: the open wound at one scale, then the scar's months ever denser.
class TimelineAxis
{
  public:
    /// `closure_day`: infinite for a wound that never closes.
    explicit TimelineAxis(double closure_day, double least_days = 30);
    TimelineAxis() : TimelineAxis(30) {}

    double day_at(double fraction) const; // of the axis, 0..1
    double fraction_of(double day) const; // the inverse
    double last_day() const { return last_day_; }
    double closure_day() const { return closure_day_; }
    /// Where the scale changes.
    double even_until() const { return even_days_; }

    struct Tick
    {
        double day;
        std::string label;
    };
    /// Days, weeks or months as there is room, at most `most`.
    std::vector<Tick> ticks(std::size_t most) const;
    bool operator==(const TimelineAxis&) const = default;

  private:
    double closure_day_, even_days_, last_day_, even_share_;
};

/// Time running over the days.
struct Playback
{
    TimelineAxis axis;
    double day = 0;
    double days_per_second = 3; // while the wound is open; the scar's months pass as fast along the axis
    bool playing = false;

    /// From the beginning when it stands at the end.
    void toggle();
    /// Stops at the last day.
    void advance(double seconds);
    void seek(double to);
};

/// While the picture moves it is rendered smaller, so that it can follow; when it stands still, once in full.
class Quality
{
  public:
    /// A picture was rendered at `scale` (1: full size) in `ms`.
    void rendered(double scale, double ms);
    /// Something moves, at the time `now`.
    void moving(double now) { moving_until_ = now + calm_s; }
    /// At which scale to render now: 1 or less.
    double scale(double now) const { return now < moving_until_ ? moving_scale_ : 1; }
    /// Seconds until the full picture is due; none when it is there already.
    std::optional<double> due_in(double now) const;

  private:
    static constexpr double calm_s = .15, wanted_ms = 40;
    double moving_scale_ = 1, moving_until_ = -1, rendered_scale_ = 1;
};

/// Lines for the user that go after a while; errors stay until they are clicked away.
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
    /// When the next one goes; none: no need to wake.
    std::optional<double> next_change() const;
    const std::deque<Notice>& list() const { return list_; }

  private:
    void add(Notice notice); // once only, as the latest

    std::deque<Notice> list_;
};

} // namespace demo_command
