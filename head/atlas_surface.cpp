#include "head/atlas_surface.hpp"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "head/weld.hpp"

namespace head {
namespace {

constexpr float longest_miter = 2; // of a skirt, in its widths

std::uint64_t pair_of(std::uint32_t a, std::uint32_t b)
{
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

/// An edge of a home triangle.
struct Side
{
    const AtlasTriangle* triangle = nullptr;
    std::uint32_t corner = 0; // the edge goes from it to the next
};

/// The unit vector across an edge, away from `off`; zero if they are in line.
template <typename Vec>
Vec across(const Vec& from, const Vec& to, const Vec& off)
{
    const Vec along = to - from, side = off - from;
    const float square = glm::dot(along, along);
    const Vec away = -(side - along * (square > 0 ? glm::dot(side, along) / square : 0.0f));
    const float length = glm::length(away);
    return length > 1e-9f ? away / length : Vec(0.0f);
}

class Surfacing
{
  public:
    Surfacing(const Model& model, std::span<const AtlasTile> tiles, bool skirts) : model_(model)
    {
        if (skirts)
            find_edges(tiles);
        for (const AtlasTile& tile : tiles) {
            if (tile.home.empty())
                continue;
            SurfacePiece piece{tile.corner, tile.size, std::uint32_t(surface.indices.size())};
            if (skirts)
                add_skirts(tile);
            piece.skirts = std::uint32_t(surface.indices.size()) - piece.first_index;
            for (const std::vector<AtlasTriangle>* triangles : {&tile.margin, &tile.home})
                for (const AtlasTriangle& triangle : *triangles)
                    add(triangle);
            piece.triangles = std::uint32_t(surface.indices.size()) - piece.first_index - piece.skirts;
            surface.pieces.push_back(piece);
        }
    }

    AtlasSurface surface;

  private:
    std::uint32_t index(const AtlasTriangle& triangle, std::uint32_t corner) const
    {
        return model_.indices[triangle.first + corner % 3];
    }
    const glm::vec3& position(const AtlasTriangle& triangle, std::uint32_t corner) const
    {
        return model_.vertices[index(triangle, corner)].position;
    }
    static const glm::vec2& at(const AtlasTriangle& triangle, std::uint32_t corner)
    {
        return triangle.at[corner % 3];
    }

    void find_edges(std::span<const AtlasTile> tiles)
    {
        point_of_ = weld<3>(model_.vertices.size(), [&](std::size_t v) {
            const glm::vec3& p = model_.vertices[v].position;
            return Key<3>{{bits_of(p.x), bits_of(p.y), bits_of(p.z)}};
        });
        for (const AtlasTile& tile : tiles)
            for (const AtlasTriangle& triangle : tile.home)
                for (std::uint32_t corner = 0; corner < 3; ++corner)
                    sides_[edge(triangle, corner)].push_back({&triangle, corner});
    }

    std::uint64_t edge(const AtlasTriangle& triangle, std::uint32_t corner) const
    {
        return pair_of(point_of_[index(triangle, corner)], point_of_[index(triangle, corner + 1)]);
    }

    bool same_start(const Side& side, const AtlasTriangle& triangle, std::uint32_t corner) const
    {
        return point_of_[index(*side.triangle, side.corner)] == point_of_[index(triangle, corner)];
    }

    /// The other triangle at this edge; null triangle if there is none. `seam`: false if it joins it on the
    /// atlas too.
    Side other_side(const AtlasTriangle& triangle, std::uint32_t corner, bool& seam) const
    {
        Side found;
        seam = true;
        for (const Side& side : sides_.at(edge(triangle, corner))) {
            if (side.triangle == &triangle)
                continue;
            const bool same = same_start(side, triangle, corner);
            const glm::vec2 &a = at(*side.triangle, side.corner + (same ? 0 : 1)),
                            &b = at(*side.triangle, side.corner + (same ? 1 : 0));
            if (a == at(triangle, corner) && b == at(triangle, corner + 1)) {
                seam = false;
                return side;
            }
            if (!found.triangle)
                found = side;
        }
        return found;
    }

    void add(const AtlasTriangle& triangle)
    {
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            const glm::vec2& place = at(triangle, corner);
            const std::uint32_t own = index(triangle, corner);
            const auto [known, is_new] = known_.try_emplace(Key<3>{{own, bits_of(place.x), bits_of(place.y)}},
                                                            std::uint32_t(surface.vertices.size()));
            if (is_new)
                surface.vertices.push_back(
                    {.at = place, .from = place, .position = model_.vertices[own].position});
            surface.indices.push_back(known->second);
        }
    }

    void add_skirts(const AtlasTile& tile)
    {
        struct Strip
        {
            Side inner, outer;
        };
        std::vector<Strip> strips;
        std::map<std::pair<float, float>, glm::vec2> outward; // sums, by place on the atlas
        for (const AtlasTriangle& triangle : tile.home)
            for (std::uint32_t corner = 0; corner < 3; ++corner) {
                bool seam = true;
                const Side other = other_side(triangle, corner, seam);
                const glm::vec2 &a = at(triangle, corner), &b = at(triangle, corner + 1);
                const glm::vec2 away = across(a, b, at(triangle, corner + 2));
                if (!seam || away == glm::vec2(0.0f))
                    continue;
                outward[{a.x, a.y}] += away;
                outward[{b.x, b.y}] += away;
                strips.push_back({{&triangle, corner}, other});
            }
        for (const Strip& strip : strips)
            add_skirt(strip.inner, strip.outer, [&](const glm::vec2& place) {
                return mitred(outward.at({place.x, place.y}));
            });
    }

    template <typename OutwardAt>
    void add_skirt(const Side& inner, const Side& outer, const OutwardAt& outward_at)
    {
        const glm::vec2 &a = at(*inner.triangle, inner.corner), &b = at(*inner.triangle, inner.corner + 1);
        const glm::vec3 &pa = position(*inner.triangle, inner.corner),
                        &pb = position(*inner.triangle, inner.corner + 1);
        const glm::vec2 along = b - a, away = across(a, b, at(*inner.triangle, inner.corner + 2));
        const float length = std::max(glm::length(along), 1e-9f);
        // Images of one unit across the edge, and of the edge itself: in the other chart and in space.
        glm::vec2 from_a = a, from_along = along, from_away(0.0f);
        glm::vec3 p_away = across(pa, pb, position(*inner.triangle, inner.corner + 2));
        if (outer.triangle) {
            const AtlasTriangle& other = *outer.triangle;
            const bool same = same_start(outer, *inner.triangle, inner.corner);
            from_a = at(other, outer.corner + (same ? 0 : 1));
            const glm::vec2 from_b = at(other, outer.corner + (same ? 1 : 0));
            from_along = from_b - from_a;
            from_away =
                -across(from_a, from_b, at(other, outer.corner + 2)) * glm::length(from_along) / length;
            p_away = -across(pa, pb, position(other, outer.corner + 2));
        }
        p_away *= glm::length(pb - pa) / length;
        const auto first = std::uint32_t(surface.vertices.size());
        for (const bool end : {false, true}) {
            const glm::vec2 place = end ? b : a, out = outward_at(place);
            const float share = glm::dot(out, along) / (length * length), across_units = glm::dot(out, away);
            SurfaceVertex vertex{.at = place,
                                 .from = from_a + (end ? from_along : glm::vec2(0.0f)),
                                 .position = end ? pb : pa};
            surface.vertices.push_back(vertex);
            vertex.at_outward = out;
            vertex.from_outward = (outer.triangle ? share : 0.0f) * from_along + across_units * from_away;
            vertex.position_outward = share * (pb - pa) + across_units * p_away;
            surface.vertices.push_back(vertex);
        }
        for (const std::uint32_t k : {0, 2, 3, 0, 3, 1})
            surface.indices.push_back(first + k);
    }

    const Model& model_;
    std::vector<std::uint32_t> point_of_; // by vertex: equal at one position
    std::unordered_map<std::uint64_t, std::vector<Side>> sides_;
    std::unordered_map<Key<3>, std::uint32_t, Key<3>::Hash> known_; // vertices of triangles
};

} // namespace

glm::vec2 mitred(const glm::vec2& across)
{
    const float square = std::max(glm::dot(across, across), 1e-6f);
    return across * std::min(2 / square, longest_miter / std::sqrt(square));
}

AtlasSurface surface_of(const Model& model, std::span<const AtlasTile> tiles, bool skirts)
{
    return std::move(Surfacing(model, tiles, skirts).surface);
}

} // namespace head
