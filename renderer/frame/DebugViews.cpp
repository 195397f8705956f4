#include "renderer/frame/DebugViews.h"

#include <algorithm>
#include <array>
#include <string>

#include "shaders/shared/display.h"
#include "shaders/shared/heat.h"
#include "shaders/shared/views.h"

namespace tessera::frame {

namespace {

constexpr DebugViewInfo kViews[] = {
    {DebugView::Final, 7, "final", "the lit picture", DisplayMapping::Radiance},
    {DebugView::Diffuse, 1, "diffuse", "base colour or k_d, textures included", DisplayMapping::Radiance},
    {DebugView::NormalTexel, 2, "normal_texel", "the normal map's texel as stored", DisplayMapping::Raw},
    {DebugView::Normal, 3, "normal", "the normal that is lit, world space", DisplayMapping::Signed},
    {DebugView::NormalView, 0, "normal_view", "the normal that is lit in view space: x right, y up, z towards the eye",
     DisplayMapping::Signed},
    {DebugView::NormalObject, 0, "normal_object",
     "the normal that is lit in the object's own space; 0 where the node flattens it", DisplayMapping::Signed},
    {DebugView::Distribution, 4, "distribution", "D of one light: the one that shines alone, else the first",
     DisplayMapping::Compressed},
    {DebugView::Geometry, 5, "geometry", "G of one light", DisplayMapping::Radiance},
    {DebugView::Fresnel, 6, "fresnel", "F of one light", DisplayMapping::Radiance},
    {DebugView::Shadow, 0, "shadow",
     "what casters let through, 1 where nothing hides it, of the light that shines alone, else of the first in view "
     "that casts shadows",
     DisplayMapping::Raw},
    {DebugView::Cascades, 0, "cascades",
     "which shadow map answers for the light of `shadow`: cascades or faces in colours with a legend, grey where none "
     "does",
     DisplayMapping::Raw},
    {DebugView::ShadowAtlas, 0, "shadow_atlas",
     "all shadow maps: casters brighter the nearer to their light, rims in the colours of `cascades`",
     DisplayMapping::ShadowAtlas},
    {DebugView::Depth, 0, "depth", "distance along the view axis in metres", DisplayMapping::Distance},
    {DebugView::Overdraw, 0, "overdraw",
     "how many surfaces the technique shades or stores, as heat colours with a legend", DisplayMapping::Count, true},
    {DebugView::Lights, 0, "lights", "how many lights the pixel visits, as heat colours with a legend",
     DisplayMapping::Count, true},
    {DebugView::Faults, 0, "faults",
     "the lit picture in grey; NaN magenta, infinite cyan, negative yellow, with a legend", DisplayMapping::Faults},
    {DebugView::MovedTooFar, 0, "moved_too_far",
     "grey surfaces; magenta where the scene's hook moves vertices farther than `mayMoveMetres`, cyan where it moves "
     "them nowhere",
     DisplayMapping::Radiance},
    {DebugView::Ids, 0, "ids",
     "which triangle each pixel shows: mesh instance, triangle, and a sum over transparent ones", DisplayMapping::Ids},
};
static_assert(int(DebugView::Final) == VIEW_FINAL && int(DebugView::Diffuse) == VIEW_DIFFUSE);
static_assert(int(DebugView::NormalTexel) == VIEW_NORMAL_TEXEL && int(DebugView::Normal) == VIEW_NORMAL);
static_assert(int(DebugView::Distribution) == VIEW_DISTRIBUTION && int(DebugView::Geometry) == VIEW_GEOMETRY);
static_assert(int(DebugView::Fresnel) == VIEW_FRESNEL && int(DebugView::Depth) == VIEW_DEPTH);
static_assert(int(DebugView::Lights) == VIEW_LIGHTS && int(DebugView::Ids) == VIEW_IDS);
static_assert(int(DebugView::NormalView) == VIEW_NORMAL_VIEW && int(DebugView::NormalObject) == VIEW_NORMAL_OBJECT);
static_assert(int(DebugView::Shadow) == VIEW_SHADOW && int(DebugView::Cascades) == VIEW_CASCADES);
static_assert(int(DebugView::MovedTooFar) == VIEW_MOVED_TOO_FAR);
static_assert(int(DebugView::Overdraw) == VIEW_OVERDRAW && int(DebugView::Faults) == VIEW_FAULTS);
static_assert(int(DebugView::ShadowAtlas) == VIEW_SHADOW_ATLAS && int(DebugView::Stored) == VIEW_STORED);

static_assert(static_cast<unsigned>(DisplayMapping::Radiance) == DISPLAY_RADIANCE);
static_assert(static_cast<unsigned>(DisplayMapping::Raw) == DISPLAY_RAW);
static_assert(static_cast<unsigned>(DisplayMapping::Signed) == DISPLAY_SIGNED);
static_assert(static_cast<unsigned>(DisplayMapping::Distance) == DISPLAY_DISTANCE);
static_assert(static_cast<unsigned>(DisplayMapping::Count) == DISPLAY_COUNT);
static_assert(static_cast<unsigned>(DisplayMapping::Ids) == DISPLAY_IDS);
static_assert(static_cast<unsigned>(DisplayMapping::Compressed) == DISPLAY_COMPRESSED);
static_assert(static_cast<unsigned>(DisplayMapping::Faults) == DISPLAY_FAULTS);
static_assert(static_cast<unsigned>(DisplayMapping::ShadowAtlas) == DISPLAY_SHADOW_ATLAS);

constexpr std::size_t kStoredViews = 2 * kChannelCount;

/// The views above, and two per G-buffer channel.
struct Table {
    std::array<std::string, kStoredViews> names, meanings;
    std::vector<DebugViewInfo> rows{std::begin(kViews), std::end(kViews)};

    Table() {
        for (std::size_t i = 0; i < kStoredViews; ++i) {
            const DebugView view = DebugView(std::size_t(DebugView::Stored) + i);
            const StoredComponents shown = *storedComponents(view);
            const ChannelInfo& channel = channelTable()[std::size_t(shown.channel)];
            names[i] = "gbuffer." + std::string(channel.name) + (shown.fourth ? ".w" : "");
            meanings[i] = "G-buffer channel as stored" + std::string(shown.fourth ? ", fourth component" : "") + ": " +
                          std::string(channel.meaning);
            rows.push_back({view, 0, names[i], meanings[i], DisplayMapping::Raw, true, true});
        }
    }
    Table(const Table&) = delete;
    Table& operator=(const Table&) = delete;
};

const std::vector<DebugViewInfo>& rows() {
    static const Table table;
    return table.rows;
}

} // namespace

std::span<const DebugViewInfo> debugViewTable() {
    return rows();
}

const DebugViewInfo& debugViewInfo(DebugView view) {
    return *std::find_if(rows().begin(), rows().end(), [view](const DebugViewInfo& info) { return info.view == view; });
}

DebugView storedDebugView(StoredComponents components) {
    return DebugView(std::size_t(DebugView::Stored) + 2 * std::size_t(components.channel) +
                     (components.fourth ? 1 : 0));
}

std::optional<StoredComponents> storedComponents(DebugView view) {
    if (view < DebugView::Stored) return std::nullopt;
    const std::size_t place = std::size_t(view) - std::size_t(DebugView::Stored);
    return StoredComponents{Channel(place / 2), place % 2 == 1};
}

int countScaleLog2(DebugView view) {
    return view == DebugView::Overdraw ? HEAT_SURFACES_LOG2 : HEAT_LIGHTS_LOG2;
}

DisplayMapping displayMapping(DebugView view, const GBufferLayout& layout) {
    const std::optional<StoredComponents> stored = storedComponents(view);
    if (!stored) return debugViewInfo(view).mapping;
    const bool direction = channelTable()[std::size_t(stored->channel)].isDirection;
    const bool exact = layout[stored->channel] == Encoding::Exact;
    return direction && exact && !stored->fourth ? DisplayMapping::Signed : DisplayMapping::Raw;
}

bool needsNormalTexel(DebugView view) {
    const std::optional<StoredComponents> stored = storedComponents(view);
    if (stored) return stored->channel == Channel::NormalTexel;
    return view == DebugView::NormalTexel || view == DebugView::NormalObject;
}

int shaderView(DebugView view) {
    return view < DebugView::Overdraw ? int(view) : int(DebugView::Final);
}

} // namespace tessera::frame
