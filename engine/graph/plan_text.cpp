#include "engine/graph/plan_text.hpp"

#include "engine/graph/pass_work.hpp"

#include "engine/graph/formats.hpp"
#include "engine/graph/graph_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>

namespace graph {

namespace {

const char* layout_name(VkImageLayout layout)
{
    switch (layout) {
    case VK_IMAGE_LAYOUT_GENERAL:
        return "general";
    case VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL:
        return "shader read";
    case VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL:
        return "colour target";
    case VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL:
        return "depth target";
    case VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL:
        return "copy source";
    default:
        return "undefined";
    }
}

std::string stage_names(VkPipelineStageFlags2 stages)
{
    struct Stage
    {
        VkPipelineStageFlags2 bit;
        const char* name;
    };
    constexpr std::array<Stage, 7> names{{
        {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, "compute"},
        {VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT, "vertex"},
        {VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, "fragment"},
        {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, "colour output"},
        {VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT, "early depth"},
        {VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT, "late depth"},
        {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, "copy"},
    }};
    std::vector<const char*> list;
    for (const Stage& stage : names)
        if (stages & stage.bit)
            list.push_back(stage.name);
    return list.empty() ? "nothing" : fmt::format("{}", fmt::join(list, "+"));
}

std::string barrier_text(const Graph& graph, const ImageBarrier& entry)
{
    const Barrier& b = entry.barrier;
    return fmt::format("{}: {} -> {}, {} -> {}", graph.images[entry.image.index].name,
                       stage_names(b.src_stages), stage_names(b.dst_stages), layout_name(b.old_layout),
                       layout_name(b.new_layout));
}

std::string desc_text(const ImageDesc& desc)
{
    const Format* format = find_format(desc.format);
    return fmt::format("{} x {} {}{}", desc.width, desc.height, format ? format->name : "?",
                       desc.samples > 1 ? fmt::format(", {} samples", desc.samples) : "");
}

/// Names of the images that a pass reads or writes, each once, in order.
std::vector<std::string> accessed_names(const Graph& graph, const Pass& pass, bool writes)
{
    std::vector<std::string> names;
    std::set<std::uint32_t> seen;
    for (const ImageAccess& access : accesses(pass))
        if (access_row(access.usage).writes == writes && seen.insert(access.image.index).second)
            names.push_back(graph.images[access.image.index].name);
    return names;
}

std::string in_dot_quotes(std::string_view text)
{
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            result += '\\';
        if (c == '\n')
            result += "\\n";
        else
            result += c;
    }
    return result + '"';
}

} // namespace

std::string plan_text(const Graph& graph, const Plan& plan)
{
    std::string text = "passes, in order of execution\n";
    for (const PassPlan& planned : plan.passes) {
        const Pass& pass = graph.passes[planned.pass];
        text += fmt::format("  {:<24} {:<8} {}{}\n", planned.name, name_of(planned.state), planned.reason,
                            planned.region && planned.state == PassState::Run
                                ? fmt::format("; refreshed: {:.1f} %", 100 * refreshed_share(graph, planned))
                                : "");
        if (const auto reads = accessed_names(graph, pass, false); !reads.empty())
            text += fmt::format("      reads    {}\n", fmt::join(reads, ", "));
        text += fmt::format("      writes   {}\n", fmt::join(accessed_names(graph, pass, true), ", "));
        for (const ImageBarrier& barrier : planned.barriers)
            text += fmt::format("      barrier  {}\n", barrier_text(graph, barrier));
    }
    for (const ImageBarrier& barrier : plan.final_barriers)
        text += fmt::format("  at the end: barrier  {}\n", barrier_text(graph, barrier));
    text += "images\n";
    for (std::size_t i = 0; i < graph.images.size(); ++i) {
        const Graph::Image& image = graph.images[i];
        const ImagePlan& planned = plan.images[i];
        std::string life = "not needed in this frame";
        if (planned.first != ~0u)
            life =
                fmt::format("from {} to {}", plan.passes[planned.first].name, plan.passes[planned.last].name);
        if (image.external)
            life = "imported, " + life;
        else if (planned.first != ~0u && !planned.needed)
            life += ", contents not kept";
        text += fmt::format("  {:<24} {:<28} {}\n", image.name, desc_text(image.desc), life);
    }
    return text;
}

std::string plan_dot(const Graph& graph, const Plan& plan)
{
    std::string text = "digraph frame {\n  rankdir=LR;\n  node [fontname=\"sans-serif\"];\n";
    for (const PassPlan& planned : plan.passes) {
        const char* style = planned.state == PassState::Run       ? "filled"
                            : planned.state == PassState::Skipped ? "dashed"
                                                                  : "dotted";
        text += fmt::format(
            "  {} [shape=box, style={}, label={}];\n", in_dot_quotes("pass " + planned.name), style,
            in_dot_quotes(planned.name + "\n" + name_of(planned.state) + ": " + planned.reason));
    }
    for (const Graph::Image& image : graph.images)
        text += fmt::format("  {} [shape=ellipse{}, label={}];\n", in_dot_quotes("image " + image.name),
                            image.external ? ", style=bold" : "",
                            in_dot_quotes(image.name + "\n" + desc_text(image.desc)));
    for (const PassPlan& planned : plan.passes) {
        std::set<std::uint32_t> waiting;
        for (const ImageBarrier& barrier : planned.barriers)
            waiting.insert(barrier.image.index);
        std::set<std::pair<std::uint32_t, bool>> drawn;
        for (const ImageAccess& access : accesses(graph.passes[planned.pass])) {
            const bool writes = access_row(access.usage).writes;
            if (!drawn.emplace(access.image.index, writes).second)
                continue;
            const std::string image = in_dot_quotes("image " + graph.images[access.image.index].name);
            const std::string pass = in_dot_quotes("pass " + planned.name);
            text += fmt::format("  {} -> {}{};\n", writes ? pass : image, writes ? image : pass,
                                waiting.contains(access.image.index) ? " [label=barrier]" : "");
        }
    }
    for (const Graph::Readback& readback : graph.readbacks)
        text +=
            fmt::format("  {} -> {};\n", in_dot_quotes("image " + graph.images[readback.image.index].name),
                        in_dot_quotes("readback " + readback.name));
    for (const ImageId id : graph.presented)
        text += fmt::format("  {} -> window;\n", in_dot_quotes("image " + graph.images[id.index].name));
    return text + "}\n";
}

} // namespace graph
