#include "wound/optics/tissue.hpp"

namespace optics {

Stack SkinLayers::channel(std::size_t index) const
{
    Stack stack{.layers = {}, .n_above = n_above, .n_below = n_below};
    for (const Layer& layer : layers)
        stack.layers.push_back(
            {layer.sigma_a[index], layer.sigma_s_reduced[index], layer.g, layer.n, layer.thickness_mm});
    return stack;
}

SkinLayers table1(double epidermis_mm, double dermis_mm, double subcutis_mm)
{
    return {.layers = {{"epidermis", {.04, 1.44, 2.08}, {10.5, 11, 11.6}, .2, 1.5, epidermis_mm},
                       {"dermis", {.001, .232, .239}, {7, 7.3, 7.5}, .76, 1.4, dermis_mm},
                       {"subcutis", {.078, .75, .53}, {5.9, 6.3, 6.7}, .73, 1.4, subcutis_mm}},
            .n_above = 1,
            .n_below = 1.4};
}

} // namespace optics
