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
/// An image that was read from a file.
struct PictureTruth {
    std::string path;
    Picture picture;
};
/// A technique, an image, or the reference.
using Truth = std::variant<engine::Technique, PictureTruth, Reference>;

/// A technique with another G-buffer layout than the request's.
struct LayoutPair {
    engine::Technique technique;
    const frame::LayoutInfo* layout; ///< a row of frame::layoutTable()
};

/// The images to compare, and how.
struct CompareRequest {
    std::vector<engine::Technique> techniques;
    std::vector<LayoutPair> layouts = {}; ///< further pairs, after those of the techniques
    Truth against = engine::Technique::Forward;
    frame::FrameSettings settings;
    bool hardwareFilter = true;                ///< whether to measure hardware filtering beside the exact one
    bool channelShares = true;                 ///< whether to measure what each packed channel adds to the error
    std::optional<Tolerance> tolerance;        ///< replaces the default tolerance of each pair
    std::function<void()> renderedOne = [] {}; ///< called stepCount() times from any thread, for progress
};

/// An image of the comparison, linear and after display mapping.
struct NamedPicture {
    std::string name;
    Picture picture;
    DisplayImage display;
};

/// The truth of one image: the truth itself, or the nearest image that the reference allows.
struct PairTruth {
    Picture picture;
    /// Per pixel, 1 where the truth shows another surface, so that nothing is compared; empty without the reference.
    std::vector<std::uint8_t> excluded;
};

struct CompareResult {
    CompareRecord record;
    NamedPicture truth;
    std::vector<NamedPicture> pictures; ///< parallel to record.pairs
    std::vector<PairTruth> truths;      ///< parallel to record.pairs: the truth of each
};

/// Resets settings that change only how an image is made (engine::Setting::samePicture) to their defaults, where the
/// technique does not support the requested value.
frame::FrameSettings supportedSettings(engine::Technique technique, const frame::FrameSettings& settings);
/// The same where the technique ignores the setting. A setting that it reads stays, even if unsupported.
frame::FrameSettings settingsUsedBy(engine::Technique technique, const frame::FrameSettings& settings);

/// Number of progress steps of compareTechniques(): images, rows of the reference's images, and the range tolerance.
std::size_t stepCount(const scenes::Scene& scene, const CompareRequest& request);

/// Names of the images that compareTechniques() measures, in its order: "deferred", "tiled_deferred (packed)" ...
std::vector<std::string> pictureNames(const scenes::Scene& scene, const CompareRequest& request);

/// Renders every technique and measures it against the truth. Pairs that must be bit-identical (no G-buffer, or the
/// truth's layout, on a software rasteriser) are checked for that; see pairTolerance(). If the G-buffer is packed, the
/// error of each channel is found by storing that channel alone in fp32, once for techniques with bit-identical images.
/// Unless the truth is a file or packed itself, the image with all channels in fp32 must also meet the exact layout's
/// tolerance. The light dropped by a range tolerance is measured on the truth's technique, or on the first technique if
/// the truth is none. Against the reference, pixels that show other triangles are excluded, and hardware texture
/// filtering is a pair of its own (hardwareFilterName()), against the reference's image with that filter.
CompareResult compareTechniques(engine::Renderer& renderer, const gpu::Capabilities& gl, const CompareRequest& request);

/// The name of a technique in the pair with hardware filtering.
std::string hardwareFilterName(const std::string& technique);

/// The techniques that support all settings that they read. The others go to `leftOut` with the reason.
std::vector<engine::Technique> techniquesSupporting(const frame::FrameSettings& settings,
                                                    std::vector<LeftOutTechnique>& leftOut);

/// The tolerance of a technique against another in a scene with `lightCount` lights; Tolerance::reason is its reason.
/// `packing` is the coarser packing of the two, or exact if both are packed alike.
Tolerance pairTolerance(engine::Technique technique, const frame::GBufferLayout& packing, bool isSoftware,
                        std::size_t lightCount);

} // namespace tessera::validation
