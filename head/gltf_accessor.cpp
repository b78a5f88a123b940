#include "head/gltf_accessor.hpp"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <limits>

#include "base/input_error.hpp"

namespace head {
namespace {

constexpr std::size_t max_count = 30'000'000; // elements of one accessor; ten million triangles

int component_size(int type)
{
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return 4;
    default: // signed int and double are not glTF
        return 0;
    }
}

template <typename T>
T load(const std::uint8_t* bytes)
{
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

template <typename T>
double integer(const std::uint8_t* bytes, bool normalized)
{
    const double value = load<T>(bytes);
    return normalized ? std::max(value / std::numeric_limits<T>::max(), -1.0) : value; // glTF 2.0, 3.11
}

/// A double holds every one of glTF's component types exactly.
double component(const std::uint8_t* bytes, int type, bool normalized)
{
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return integer<std::int8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return integer<std::uint8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return integer<std::int16_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return integer<std::uint16_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return integer<std::uint32_t>(bytes, normalized);
    default:
        return load<float>(bytes);
    }
}

/// Whether `count` elements of `size` bytes, `stride` bytes apart, starting at `offset`, lie within `length`
/// bytes. Cannot overflow.
bool fits(std::size_t offset, std::size_t count, std::size_t stride, std::size_t size, std::size_t length)
{
    if (count == 0)
        return offset <= length;
    return offset <= length && length - offset >= size && count - 1 <= (length - offset - size) / stride;
}

} // namespace

std::string GltfReader::where(std::string_view field) const
{
    return fmt::format("{}: {}", file_, field);
}

void GltfReader::refuse(std::string_view field, std::string_view what, std::string_view cure) const
{
    throw base::InputError(where(field), what, cure);
}

std::span<const std::uint8_t> GltfReader::view(int buffer_view, std::string_view field) const
{
    if (buffer_view < 0 || static_cast<std::size_t>(buffer_view) >= gltf_.bufferViews.size())
        refuse(field, fmt::format("there is no buffer view {}", buffer_view));
    const tinygltf::BufferView& view = gltf_.bufferViews[buffer_view];
    if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= gltf_.buffers.size())
        refuse(fmt::format("/bufferViews/{}/buffer", buffer_view),
               fmt::format("there is no buffer {}", view.buffer));
    const auto& bytes = gltf_.buffers[view.buffer].data;
    if (view.byteOffset > bytes.size() || view.byteLength > bytes.size() - view.byteOffset)
        refuse(fmt::format("/bufferViews/{}", buffer_view),
               fmt::format("bytes {} + {} lie outside the buffer's {}", view.byteOffset, view.byteLength,
                           bytes.size()));
    return std::span(bytes).subspan(view.byteOffset, view.byteLength);
}

const tinygltf::Accessor& GltfReader::accessor_at(int accessor, std::string_view field) const
{
    if (accessor < 0 || static_cast<std::size_t>(accessor) >= gltf_.accessors.size())
        refuse(field, fmt::format("there is no accessor {}", accessor));
    const tinygltf::Accessor& found = gltf_.accessors[accessor];
    if (found.count > max_count)
        refuse(fmt::format("/accessors/{}/count", accessor),
               fmt::format("{} is more than the limit of {}", found.count, max_count), "use a smaller model");
    return found;
}

std::size_t GltfReader::count(int accessor, std::string_view field) const
{
    return accessor_at(accessor, field).count;
}

/// Calls store(element, component, value) for the accessor's elements, then for the elements that its sparse
/// part replaces.
template <typename Store>
void GltfReader::visit(const tinygltf::Accessor& accessor, std::string_view field, Store&& store) const
{
    const int type = accessor.componentType;
    const std::size_t size = component_size(type);
    const std::size_t components = std::max(tinygltf::GetNumComponentsInType(accessor.type), 1);
    if (size == 0)
        refuse(field, fmt::format("component type {} is not one of glTF's", type));
    const auto store_element = [&](std::size_t element, const std::uint8_t* bytes) {
        for (std::size_t c = 0; c < components; ++c)
            store(element, c, component(bytes + c * size, type, accessor.normalized));
    };

    if (accessor.bufferView >= 0) { // otherwise the elements are zero
        const auto bytes = view(accessor.bufferView, field);
        const std::size_t byte_stride = gltf_.bufferViews[accessor.bufferView].byteStride;
        const std::size_t stride = byte_stride ? byte_stride : size * components;
        if (!fits(accessor.byteOffset, accessor.count, stride, size * components, bytes.size()))
            refuse(field, fmt::format("its {} elements reach beyond buffer view {}", accessor.count,
                                      accessor.bufferView));
        for (std::size_t i = 0; i < accessor.count; ++i)
            store_element(i, bytes.data() + accessor.byteOffset + i * stride);
    }
    if (!accessor.sparse.isSparse)
        return;
    const auto& sparse = accessor.sparse;
    const auto places = view(sparse.indices.bufferView, field),
               values = view(sparse.values.bufferView, field);
    const std::size_t place_size = component_size(sparse.indices.componentType);
    const bool unsigned_places = sparse.indices.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                                 sparse.indices.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                                 sparse.indices.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    if (sparse.count < 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0 || !unsigned_places)
        refuse(field, "its sparse part is malformed");
    const std::size_t sparse_count = sparse.count, places_at = sparse.indices.byteOffset,
                      values_at = sparse.values.byteOffset;
    if (!fits(places_at, sparse_count, place_size, place_size, places.size()) ||
        !fits(values_at, sparse_count, size * components, size * components, values.size()))
        refuse(field, "its sparse part reaches beyond its buffer view");
    for (std::size_t i = 0; i < sparse_count; ++i) {
        const double place =
            component(places.data() + places_at + i * place_size, sparse.indices.componentType, false);
        if (place >= static_cast<double>(accessor.count))
            refuse(field, fmt::format("its sparse part names element {} of {}", place, accessor.count));
        store_element(static_cast<std::size_t>(place), values.data() + values_at + i * size * components);
    }
}

std::vector<float> GltfReader::numbers(int accessor, int components, std::string_view field) const
{
    const tinygltf::Accessor& source = accessor_at(accessor, field);
    if (tinygltf::GetNumComponentsInType(source.type) != components || source.type > TINYGLTF_TYPE_VEC4)
        refuse(field, fmt::format("accessor {} does not have {} components", accessor, components));
    std::vector<float> values(source.count * components, 0.0f);
    visit(source, field, [&](std::size_t element, std::size_t c, double value) {
        values[element * components + c] = static_cast<float>(value);
    });
    return values;
}

std::vector<std::uint32_t> GltfReader::indices(int accessor, std::size_t limit, std::string_view field) const
{
    const tinygltf::Accessor& source = accessor_at(accessor, field);
    const bool is_unsigned = source.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                             source.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                             source.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    if (source.type != TINYGLTF_TYPE_SCALAR || !is_unsigned || source.normalized)
        refuse(field, fmt::format("accessor {} does not hold unsigned integers", accessor));
    std::vector<std::uint32_t> values(source.count, 0);
    visit(source, field, [&](std::size_t element, std::size_t, double value) {
        values[element] = static_cast<std::uint32_t>(value);
    });
    for (std::size_t i = 0; i < values.size(); ++i)
        if (values[i] >= limit)
            refuse(field, fmt::format("index {} names vertex {} of {}", i, values[i], limit));
    return values;
}

} // namespace head
