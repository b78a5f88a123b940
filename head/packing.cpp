#include "head/packing.hpp"

#include <algorithm>

namespace head {

std::optional<Horizon::Place> Horizon::put(std::span<const Span> shape, std::size_t tries)
{
    if (shape.size() > height_.size())
        return std::nullopt;
    const std::size_t columns = height_.size() - shape.size() + 1;
    const std::size_t start = tries < columns ? last_ : 0;
    Place best{0, 1e300};
    for (std::size_t t = 0; t < std::min(tries, columns); ++t) {
        const std::size_t column = (start + t) % columns;
        double lift = 0;
        for (std::size_t i = 0; i < shape.size() && lift < best.height; ++i)
            lift = std::max(lift, height_[column + i] - shape[i].bottom);
        if (lift < best.height)
            best = {column, lift};
    }
    for (std::size_t i = 0; i < shape.size(); ++i)
        raise(best.column + i, best.height + shape[i].top);
    last_ = best.column;
    return best;
}

void Horizon::raise(std::size_t column, double height)
{
    height_[column] = std::max(height_[column], height);
}

double Horizon::highest() const
{
    return *std::ranges::max_element(height_);
}

} // namespace head
