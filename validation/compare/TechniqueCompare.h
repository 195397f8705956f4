#pragma once
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "base/Picture.h"
#include "engine/Renderer.h"
#include "validation/compare/CompareRecord.h"

namespace tessera::validation {

/// The double-precision renderer as the truth.
struct Reference {};
/// A picture that was read from a file.
struct PictureTruth {
    std::string path;
    Picture picture;
};
/// A technique, a picture, or the reference.
using Truth = std::variant<engine::Technique, PictureTruth, Reference>;

/// A technique with another G-buffer layout than the request's.
struct LayoutPair {
    engine::Technique technique;
    const frame::LayoutInfo* layout; ///< a row of frame::layoutTable()
};

/// The pictures to compare.
struct CompareRequest {
    std::vector<engine::Technique> techniques;
    std::vector<LayoutPair> layouts = {}; ///< further pairs, after those of the techniques
    Truth against = engine::Technique::Forward;
    frame::FrameSettings settings;
    bool hardwareFilter = true;                ///< whether to measure hardware filtering beside the exact one
    bool channelShares = true;                 ///< whether to measure what each packed channel adds to the error
    std::optional<Tolerance> tolerance;        ///< instead of the one each pair is held to by itself
    std::function<void()> renderedOne = [] {}; ///< called stepCount() times from any thread, for progress
};

/// A picture of the comparison, linear and as shown.
struct NamedPicture {
    std::string name;
    Picture picture;
    DisplayImage display;
};

/// What one picture was measured against: the truth, or of the pictures that the reference allows the nearest.
struct PairTruth {
    Picture picture;
    /// By pixel: 1 where the truth shows another surface, so that nothing is compared; empty where that cannot be.
    std::vector<std::uint8_t> excluded;
};

struct CompareResult {
    CompareRecord record;
    NamedPicture truth;
    std::vector<NamedPicture> pictures; ///< parallel to record.pairs
    std::vector<PairTruth> truths;      ///< parallel to record.pairs: the truth of each
};

/// Requested settings of how a picture is made (engine::Setting::samePicture) go to the techniques that take
/// it; the others keep their own.
frame::FrameSettings settingsTakenBy(engine::Technique technique, const frame::FrameSettings& settings);
/// The same for techniques that do not heed it at all: what one heeds and does not take stays.
frame::FrameSettings settingsHeededBy(engine::Technique technique, const frame::FrameSettings& settings);

/// Steps of compareTechniques(), for progress: pictures, each row of the reference's, and what a range tolerance drops.
std::size_t stepCount(const scenes::Scene& scene, const CompareRequest& request);

/// Names of the pictures that compareTechniques() measures, in its order: "deferred", "tiled_deferred (packed)" ...
std::vector<std::string> pictureNames(const scenes::Scene& scene, const CompareRequest& request);

/// Renders every technique and measures it against the truth. Pairs that must agree to the last bit (no G-buffer, or
/// the truth's layout, on a software rasteriser) are held to that; see pairTolerance(). Where the G-buffer is packed,
/// each channel's share of the error is found by storing that channel alone in fp32, once for techniques whose pictures
/// are equal in every bit; and unless the truth is a file or packed itself, the picture with all of them in fp32 must
/// hold the exact layout's tolerance. What a range tolerance drops is measured on the technique that is the truth, or
/// the first one where that is none. Against the reference, pixels that show other triangles are excluded; textures
/// filtered by hardware are one pair of their own there (hardwareFilterName()), against the reference's picture with
/// that filter.
CompareResult compareTechniques(engine::Renderer& renderer, const gpu::Capabilities& gl, const CompareRequest& request);

/// What the pair that shows hardware filtering beside the exact one calls a technique.
std::string hardwareFilterName(const std::string& technique);

/// The techniques that take the settings which they heed. The others go to `leftOut` with the reason.
std::vector<engine::Technique> techniquesTaking(const frame::FrameSettings& settings,
                                                std::vector<LeftOutTechnique>& leftOut);

/// What a technique is held to against another in a scene of so many lights, with the reason in Tolerance::reason.
/// `packing` is what sets the two apart: exact where both are packed alike.
Tolerance pairTolerance(engine::Technique technique, const frame::GBufferLayout& packing, bool isSoftware,
                        std::size_t lightCount);

} // namespace tessera::validation
