// Packs shapes into a strip, each as low as it fits above the earlier ones. For the skin atlas.
// Levy, Petitjean, Ray, Maillot 2002, "Least squares conformal maps for automatic texture atlas
// generation", 5.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace head {

/// The heights above which the columns of a strip are free. Columns are counted from 0, heights in any unit.
class Horizon
{
  public:
    explicit Horizon(std::size_t columns) : height_(columns, 0.) {}

    /// The part of a shape in one column; empty when bottom > top.
    struct Span
    {
        double bottom = 1e300, top = -1e300;
    };
    struct Place
    {
        std::size_t column = 0;
        double height = 0; // by which the shape was lifted
    };
    /// Puts the shape to where it is lifted the least, and raises the columns. It tries `tries` columns, from
    /// the place of the last shape on. None when the shape is wider than the strip.
    std::optional<Place> put(std::span<const Span> shape, std::size_t tries = ~std::size_t(0));
    void raise(std::size_t column, double height);

    double highest() const;

  private:
    std::vector<double> height_;
    std::size_t last_ = 0;
};

} // namespace head
