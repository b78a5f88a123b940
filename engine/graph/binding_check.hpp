// Checks that every pass gives its shaders exactly the bindings
// they declare. Uses the shaders' reflection; needs no device.
#pragma once
#include "engine/graph/graph.hpp"
#include "engine/graph/shader_library.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace graph {

/// Looks a binding up in the draw or dispatch first, then in its pass.
class BindingScope
{
  public:
    explicit BindingScope(const ComputePass& pass) : own_(pass), outer_(nullptr) {}
    BindingScope(const Draw& draw, const RasterPass& pass) : own_(draw), outer_(&pass) {}

    const Bindings::Sampled* sampled(std::string_view name) const;
    const Bindings::Stored* stored(std::string_view name) const;
    const Bindings::Data* data(std::string_view name) const;
    const Constant* constant(std::string_view name) const;

  private:
    const Bindings& own_;
    const Bindings* outer_;
};

/// One line for each mistake: "pass forward: shader forward is given no image for albedo".
std::vector<std::string> check_bindings(const Graph& graph, const ShaderLibrary& library);

} // namespace graph
