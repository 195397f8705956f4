#include "validation/stress/Stress.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/Error.h"
#include "base/Names.h"
#include "engine/Renderer.h"
#include "engine/Rendering.h"
#include "validation/compare/ReferencePicture.h"
#include "validation/compare/ShownTriangles.h"

namespace tessera::validation {

namespace {

using engine::Technique;

StressResult resultOf(const StressCase& row, std::optional<Technique> technique) {
    return {row.name, technique, {}, row.bound, row.tolerance, row.reason};
}

/// Draws the images of one case with every technique.
class PictureRun {
public:
    PictureRun(gpu::Context& context, const StressRequest& request, const StressCase& row)
        : context_(context), request_(request), pictures_(row.pictures(request.effort)) {
        for (const Technique technique : request.techniques) results_.push_back(resultOf(row, technique));
    }

    std::vector<StressResult> run(const std::function<void(double)>& progress) {
        drawn_.resize(pictures_.size());
        for (std::size_t i = 0; i < pictures_.size(); ++i) {
            compare(i);
            progress(double(i + 1) / double(pictures_.size()));
        }
        return std::move(results_);
    }

private:
    void compare(std::size_t index) {
        const StressPicture& picture = pictures_[index];
        checkScene(picture.scene);
        engine::Renderer renderer(context_, picture.scene, request_.shaders);
        std::optional<ReferencePicture> truth;
        ShownTriangles triangles;
        if (!picture.sameAs) {
            truth = referencePicture(picture.scene, picture.settings);
            triangles = shownTriangles(renderer, picture.settings, truth->ids);
        }
        for (std::size_t t = 0; t < results_.size(); ++t) {
            const Technique technique = request_.techniques[t];
            Picture shown = toPicture(renderer.render(technique, picture.settings));
            const Picture wanted = truth ? truth->nearestTo(shown) : drawn_[*picture.sameAs][t];
            results_[t].figures.addPicture(radianceFigures(measured(shown), wanted, triangles.excluded), picture.what,
                                           picture.allowed);
            if (!triangles.lost.empty()) results_[t].figures.geometryLost(picture.what, triangles.lost.front());
            if (isTruth(index)) drawn_[index].push_back(std::move(shown));
        }
    }

    Picture measured(Picture picture) const {
        for (std::size_t i = 0; i < picture.rgba.size(); ++i)
            if (i % 4 != 3) picture.rgba[i] *= request_.measuredTimes;
        return picture;
    }

    /// Whether a later image is compared with this one.
    bool isTruth(std::size_t index) const {
        return std::any_of(pictures_.begin(), pictures_.end(),
                           [index](const StressPicture& later) { return later.sameAs == index; });
    }

    gpu::Context& context_;
    const StressRequest& request_;
    std::vector<StressPicture> pictures_;
    std::vector<StressResult> results_;       ///< parallel to the request's techniques
    std::vector<std::vector<Picture>> drawn_; ///< by picture and technique; empty if no other is compared with it
};

} // namespace

std::vector<std::string> StressResult::missed() const {
    std::vector<std::string> missed;
    if (figures.samples == 0) missed.push_back("nothing was sampled");
    const auto none = [&](std::uint64_t count, const char* what) {
        if (count > 0) missed.push_back(fmt::format("{} of {} samples are {}", count, figures.samples, what));
    };
    none(figures.nan, "NaN");
    none(figures.infinite, "infinite");
    none(figures.negative, "negative");
    if (!figures.fault.empty()) missed.push_back(figures.fault);
    if (!(held() <= tolerance)) {
        const bool isRel = bound == StressBound::WorstRel;
        missed.push_back(fmt::format("{} is {:.3g}, at most {:g} is required; at {}",
                                     isRel ? "the worst relative error" : "relMse", held(), tolerance,
                                     isRel ? figures.where : figures.whereRelMse));
    }
    return missed;
}

std::vector<StressResult> runStress(gpu::Context& context, const StressRequest& request) {
    std::vector<StressResult> results;
    const auto keep = [&](StressResult result) {
        request.found(result);
        results.push_back(std::move(result));
    };
    for (std::size_t i = 0; i < request.cases.size(); ++i) {
        const StressCase& row = *request.cases[i];
        const auto progress = [&](double share) {
            request.progress((double(i) + share) / double(request.cases.size()));
        };
        progress(0.0);
        if (row.measure) {
            StressBench bench(context, request.shaders, request.effort, progress, request.measuredTimes);
            StressResult result = resultOf(row, {});
            row.measure(bench, result.figures);
            keep(std::move(result));
        } else {
            for (StressResult& result : PictureRun(context, request, row).run(progress)) keep(std::move(result));
        }
        progress(1.0);
    }
    return results;
}

std::vector<const StressCase*> stressCasesNamed(const std::string& name) {
    std::vector<const StressCase*> found;
    const std::string group = name.substr(0, name.find('/'));
    std::vector<std::string_view> groups, inGroup;
    for (const StressCase& row : stressCases()) {
        if (row.name == name || row.name.starts_with(name + "/")) found.push_back(&row);
        const std::string_view rowGroup = std::string_view(row.name).substr(0, row.name.find('/'));
        if (rowGroup == group) inGroup.push_back(row.name);
        if (groups.empty() || groups.back() != rowGroup) groups.push_back(rowGroup);
    }
    // Suggests groups or the cases of one group: all names would fill a screen.
    if (found.empty())
        throw InputError(fmt::format("case '{}': no case or group of cases is called that; {}", name,
                                     inGroup.empty() ? suggestNames(group, groups) : suggestNames(name, inGroup)));
    return found;
}

} // namespace tessera::validation
