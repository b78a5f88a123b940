#include "engine/graph/schedule.hpp"

#include "base/hash.hpp"
#include "engine/graph/graph_check.hpp"
#include "engine/graph/pass_key.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace graph {

namespace {

/// Schedules one frame.
class Scheduler
{
  public:
    Scheduler(const Graph& graph, const Memory& before)
        : graph_(graph), before_(before), states_(graph.images.size()), content_versions_(graph.images.size())
    {
    }

    Plan run()
    {
        for (const std::uint32_t pass : order_passes(graph_))
            plan_.passes.push_back({.pass = pass, .name = name_of(graph_.passes[pass])});
        for (const PassPlan& pass : plan_.passes)
            accesses_.push_back(accesses(graph_.passes[pass.pass]));
        plan_.images.resize(graph_.images.size());
        plan_.memory.frames = before_.frames + 1;
        cull();
        restore_images();
        for (std::uint32_t position = 0; position < plan_.passes.size(); ++position)
            plan_pass(position);
        finish();
        return std::move(plan_);
    }

  private:
    const std::string& image_name(ImageId id) const { return graph_.images[id.index].name; }
    static bool writes(const ImageAccess& access) { return access_row(access.usage).writes; }

    /// From the last pass to the first: a pass is needed when an image it writes is needed.
    void cull()
    {
        for (const Graph::Readback& readback : graph_.readbacks)
            need(readback.image);
        for (const ImageId id : graph_.presented)
            need(id);
        for (std::size_t i = plan_.passes.size(); i-- > 0;) {
            PassPlan& pass = plan_.passes[i];
            const bool needed =
                std::any_of(accesses_[i].begin(), accesses_[i].end(), [&](const ImageAccess& access) {
                    return writes(access) && plan_.images[access.image.index].needed;
                });
            for (const ImageAccess& access : accesses_[i]) {
                plan_.images[access.image.index].usage |= access_row(access.usage).image;
                if (needed && !writes(access))
                    plan_.images[access.image.index].needed = true;
            }
            if (!needed) {
                pass.state = PassState::Culled;
                pass.reason = why_culled(i);
            }
        }
    }

    void need(ImageId id)
    {
        plan_.images[id.index].needed = true;
        plan_.images[id.index].usage |= access_row(Usage::CopySource).image;
    }

    std::string why_culled(std::size_t position) const
    {
        const auto output = std::find_if(accesses_[position].begin(), accesses_[position].end(), writes);
        for (std::size_t i = position + 1; i < plan_.passes.size(); ++i)
            for (const ImageAccess& access : accesses_[i])
                if (!writes(access) && access.image == output->image)
                    return fmt::format("unused: only {} samples {}, and it is culled", plan_.passes[i].name,
                                       image_name(output->image));
        return "unused: nothing samples " + image_name(output->image);
    }

    /// Copies the remembered state of each image; an image that must be recreated starts without contents.
    void restore_images()
    {
        for (std::size_t i = 0; i < graph_.images.size(); ++i) {
            const Graph::Image& image = graph_.images[i];
            const auto remembered = before_.images.find(image.name);
            if (remembered != before_.images.end() && remembered->second.desc == image.desc &&
                (plan_.images[i].usage & ~remembered->second.usage) == 0)
                states_[i] = remembered->second;
            else
                states_[i] = {.desc = image.desc, .usage = plan_.images[i].usage};
            if (image.external)
                content_versions_[i] = image.external->content;
        }
    }

    void plan_pass(std::uint32_t position)
    {
        PassPlan& planned = plan_.passes[position];
        if (planned.state == PassState::Culled) {
            if (const auto key = before_.passes.find(planned.name); key != before_.passes.end())
                plan_.memory.passes.insert(*key);
            return;
        }
        for (const ImageAccess& access : accesses_[position]) {
            ImagePlan& image = plan_.images[access.image.index];
            image.first = std::min(image.first, position);
            image.last = position;
        }
        std::vector<KeyPart> key =
            pass_key(graph_, graph_.passes[planned.pass], accesses_[position], content_versions_);
        const bool always = std::visit([](const auto& p) { return p.always; }, graph_.passes[planned.pass]);
        const std::string outdated = update_outputs(position, key, always);
        planned.region = always || outdated.empty() ? std::nullopt : changed_region(position, key);
        if (outdated.empty()) {
            planned.state = PassState::Skipped;
            planned.reason = "unchanged";
        } else if (planned.region && planned.region->empty()) {
            planned.state = PassState::Skipped;
            planned.reason = "unaffected: " + why_run(planned.name, key, outdated);
            set_versions(position);
        } else {
            planned.reason = always ? "every frame" : why_run(planned.name, key, outdated);
            plan_run(position);
        }
        // Where an input that stands was drawn at, it still is, unless everything is drawn anew.
        if (const auto last = before_.passes.find(planned.name);
            last != before_.passes.end() && (planned.state == PassState::Skipped || planned.region))
            for (std::size_t i = 0; i < std::min(key.size(), last->second.size()); ++i)
                if (key[i] == last->second[i] && key[i].region && last->second[i].region)
                    key[i].region = bounds(*key[i].region, *last->second[i].region);
        plan_.memory.passes[planned.name] = std::move(key);
    }

    /// Gives every output its content_version and returns the name of the
    /// first needed output that is not up to date; empty: all are.
    std::string update_outputs(std::uint32_t position, const std::vector<KeyPart>& key, bool always)
    {
        base::Hash hash = hash_of(key);
        if (always)
            hash.add(plan_.memory.frames); // differs in every frame
        std::string outdated;
        for (const ImageAccess& access : accesses_[position]) {
            if (!writes(access))
                continue;
            const std::uint32_t image = access.image.index;
            content_versions_[image] = version_of(hash, access.image);
            if (outdated.empty() && plan_.images[image].needed &&
                states_[image].content_version != content_versions_[image])
                outdated = image_name(access.image);
        }
        return outdated;
    }

    static base::Hash hash_of(const std::vector<KeyPart>& key)
    {
        base::Hash hash;
        for (const KeyPart& part : key)
            hash.add(part.what).add(part.hash);
        return hash;
    }

    std::uint64_t version_of(const base::Hash& key, ImageId image) const
    {
        return base::Hash(key).add(image_name(image)).value();
    }

    /// The region outside of which the pass's images already hold what it would write; none: unknown.
    std::optional<Region> changed_region(std::uint32_t position, const std::vector<KeyPart>& key) const
    {
        const auto known = before_.passes.find(plan_.passes[position].name);
        if (known == before_.passes.end() || known->second.size() != key.size())
            return std::nullopt;
        const std::vector<KeyPart>& last = known->second;
        for (const ImageAccess& access : accesses_[position])
            if (writes(access) && plan_.images[access.image.index].needed &&
                states_[access.image.index].content_version != version_of(hash_of(last), access.image))
                return std::nullopt; // not what the last run wrote
        Region changed;
        for (std::size_t i = 0; i < key.size(); ++i) {
            if (key[i] == last[i])
                continue;
            if (key[i].what != last[i].what)
                return std::nullopt;
            auto touched = key[i].region;
            if (key[i].in_place || key[i].source) {
                const auto refreshed = refreshed_since(position, key[i], last[i].hash);
                if (!refreshed || (key[i].source && !holds(*key[i].source, *refreshed)))
                    return std::nullopt;
                if (key[i].in_place)
                    touched = refreshed;
            }
            if (!touched || (!key[i].in_place && !last[i].region))
                return std::nullopt;
            changed = bounds(changed, key[i].in_place ? *touched : bounds(*touched, *last[i].region));
        }
        return changed;
    }

    /// What of an input differs from its contents of version `since`; none: unknown.
    std::optional<Region> refreshed_since(std::uint32_t position, const KeyPart& input,
                                          std::uint64_t since) const
    {
        for (const ImageAccess& access : accesses_[position])
            if (!writes(access) && input.what == "input " + image_name(access.image)) {
                const ImageState& state = states_[access.image.index];
                if (since != 0 && state.refreshed_from == since)
                    return state.refreshed;
            }
        return std::nullopt;
    }

    /// Gives the images that the pass writes the versions of what they hold from now on.
    void set_versions(std::uint32_t position)
    {
        const std::optional<Region>& region = plan_.passes[position].region;
        for (const ImageAccess& access : accesses_[position]) {
            if (!writes(access))
                continue;
            ImageState& state = states_[access.image.index];
            state.refreshed_from = region ? state.content_version : 0;
            state.refreshed = region.value_or(Region{});
            state.content_version =
                plan_.images[access.image.index].needed ? content_versions_[access.image.index] : 0;
        }
    }

    std::string why_run(const std::string& pass, const std::vector<KeyPart>& key,
                        const std::string& outdated) const
    {
        const auto last = before_.passes.find(pass);
        if (last == before_.passes.end())
            return "first run";
        for (std::size_t i = 0; i < key.size(); ++i)
            if (i >= last->second.size() || last->second[i] != key[i])
                return "changed: " + key[i].what;
        if (last->second.size() > key.size())
            return "changed: " + last->second[key.size()].what + " was removed";
        return "changed: the contents of " + outdated + " were not kept";
    }

    /// Plans the barriers and store operations of a pass that runs and updates its images' state.
    void plan_run(std::uint32_t position)
    {
        PassPlan& planned = plan_.passes[position];
        for (const ImageAccess& access : accesses_[position]) {
            const std::uint32_t image = access.image.index;
            if (graph_.images[image].external)
                continue; // always in the layout for sampling
            const bool keep = planned.region && plan_.images[image].needed;
            if (const auto barrier = advance(states_[image].access, access.usage, keep))
                planned.barriers.push_back({access.image, *barrier});
        }
        set_versions(position);
        const auto store = [&](ImageId id) {
            return id.valid() && plan_.images[id.index].needed ? VK_ATTACHMENT_STORE_OP_STORE
                                                               : VK_ATTACHMENT_STORE_OP_DONT_CARE;
        };
        if (const auto* raster = std::get_if<RasterPass>(&graph_.passes[planned.pass])) {
            for (const RasterPass::ColorTarget& target : raster->colors) {
                planned.color_stores.push_back(store(target.image));
                planned.resolve_stores.push_back(store(target.resolve));
            }
            planned.depth_store = store(raster->depth_image);
        }
    }

    void finish()
    {
        std::vector<ImageId> outputs = graph_.presented;
        for (const Graph::Readback& readback : graph_.readbacks)
            outputs.push_back(readback.image);
        for (const ImageId id : outputs)
            if (const auto barrier = advance(states_[id.index].access, Usage::CopySource))
                plan_.final_barriers.push_back({id, *barrier});
        for (std::size_t i = 0; i < graph_.images.size(); ++i)
            if (!graph_.images[i].external)
                plan_.memory.images.emplace(graph_.images[i].name, states_[i]);
    }

    const Graph& graph_;
    const Memory& before_;
    Plan plan_;
    std::vector<std::vector<ImageAccess>> accesses_; // by position in plan.passes
    std::vector<ImageState> states_;                 // by image
    std::vector<std::uint64_t> content_versions_;    // by image: after its writer has run or been skipped
};

} // namespace

Plan schedule(const Graph& graph, const Memory& memory)
{
    throw_if_any(check_graph(graph));
    return schedule_checked(graph, memory);
}

Plan schedule_checked(const Graph& graph, const Memory& memory)
{
    return Scheduler(graph, memory).run();
}

const char* name_of(PassState state)
{
    switch (state) {
    case PassState::Run:
        return "ran";
    case PassState::Skipped:
        return "skipped";
    case PassState::Culled:
        break;
    }
    return "culled";
}

} // namespace graph
