#include "stage/work.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace stage {

FrameWork work_of(const gpu::FrameResult& frame, bool counted)
{
    FrameWork work;
    if (counted)
        work.invocations.emplace();
    for (const gpu::PassResult& pass : frame.passes) {
        work.passes += pass.state == graph::PassState::Run;
        work.texels += double(pass.work.texels);
        work.bytes_written += double(pass.work.bytes_written);
        work.maps_sampled += double(pass.work.maps_sampled);
        if (counted && pass.invocations) {
            work.invocations->vertex += double(pass.invocations->vertex);
            work.invocations->fragment += double(pass.invocations->fragment);
            work.invocations->compute += double(pass.invocations->compute);
        }
    }
    for (const gpu::FrameResult::Readback& readback : frame.readbacks)
        work.bytes_written += double(readback.bytes.size());
    return work;
}

FrameWork mean(std::span<const FrameWork> frames)
{
    FrameWork sum;
    double all = 0, counted = 0;
    for (const FrameWork& frame : frames) {
        ++all;
        sum.passes += frame.passes;
        sum.texels += frame.texels;
        sum.bytes_written += frame.bytes_written;
        sum.maps_sampled += frame.maps_sampled;
        if (!frame.invocations)
            continue;
        ++counted;
        if (!sum.invocations)
            sum.invocations.emplace();
        sum.invocations->vertex += frame.invocations->vertex;
        sum.invocations->fragment += frame.invocations->fragment;
        sum.invocations->compute += frame.invocations->compute;
    }
    for (double* total : {&sum.passes, &sum.texels, &sum.bytes_written, &sum.maps_sampled})
        *total /= std::max(all, 1.);
    if (sum.invocations)
        for (double* total :
             {&sum.invocations->vertex, &sum.invocations->fragment, &sum.invocations->compute})
            *total /= counted;
    return sum;
}

nlohmann::json to_json(const FrameWork& work)
{
    nlohmann::json invocations = nullptr;
    if (work.invocations)
        invocations = {{"vertex", work.invocations->vertex},
                       {"fragment", work.invocations->fragment},
                       {"compute", work.invocations->compute}};
    return {{"passes", work.passes},
            {"texels_refreshed", work.texels},
            {"bytes_written", work.bytes_written},
            {"maps_sampled", work.maps_sampled},
            {"invocations", invocations}};
}

} // namespace stage
