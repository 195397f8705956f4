// Every filter with every wrap mode against the reference, by the exact definition and by the driver's hardware.

#include <glm/gtc/matrix_transform.hpp>

#include "tests/image/FlatTest.h"
#include "tests/support/ShaderMutant.h"
#include "validation/compare/ShownTriangles.h"
#include "validation/figures/ErrorFigures.h"

namespace tessera {
namespace {

using engine::Technique;
using frame::TextureFilter;
using scenes::Filter;
using scenes::Wrap;
using namespace test;

constexpr int kTilePixels = 20, kTexels = 32;
constexpr Filter kMinifying[] = {Filter::Nearest,
                                 Filter::Linear,
                                 Filter::NearestMipmapNearest,
                                 Filter::LinearMipmapNearest,
                                 Filter::NearestMipmapLinear,
                                 Filter::LinearMipmapLinear};
constexpr Filter kMagnifying[] = {Filter::Nearest, Filter::Linear};
constexpr Wrap kWraps[] = {Wrap::Repeat, Wrap::ClampToEdge, Wrap::MirroredRepeat};
/// Filters by wrap modes along u; those along v change from filter to filter, so that every pair of modes occurs.
constexpr int kColumns = 12, kRows = 3;

/// Every texel has a different colour, with steps between neighbours and a slope overall, so that no level is uniform.
scenes::Image colourfulImage(glm::ivec2 sizeTexels, scenes::TexelFormat format) {
    scenes::Image image;
    image.name = "colours";
    image.width = sizeTexels.x;
    image.height = sizeTexels.y;
    image.format = format;
    for (int y = 0; y < sizeTexels.y; ++y)
        for (int x = 0; x < sizeTexels.x; ++x) {
            const int step = (x * 5 + y * 3) % 7;
            for (const int value : {90 + 20 * step, 60 + 190 * x / sizeTexels.x, 60 + 190 * y / sizeTexels.y, 255}) {
                const float linear = float(value) / 255.0f;
                const auto* bytes = reinterpret_cast<const std::byte*>(&linear);
                if (format == scenes::TexelFormat::Rgba32Float)
                    image.texels.insert(image.texels.end(), bytes, bytes + sizeof linear);
                else
                    image.texels.push_back(std::byte(value));
            }
        }
    return image;
}

/// Layout of the tiles.
struct Layout {
    const char* what;
    glm::dvec2 texelsPerPixel; ///< for a texture of kTexels
    float turnRadians = 0.0f;  ///< of the texture
    double slantDegrees = 0.0; ///< of the wall, in perspective; 0: parallel rays at a right angle
    glm::ivec2 sizeTexels{kTexels, kTexels};
    scenes::TexelFormat format = scenes::TexelFormat::Rgba8Unorm; ///< of sRGB colours; floats are linear
};

constexpr Layout kLayouts[] = {
    {"magnified", glm::dvec2(0.37)},
    {"a little minified", glm::dvec2(1.3)},
    {"minified upwards alone", {0.6, 2.4}},
    {"minified sideways alone", {2.4, 0.6}},
    {"minified, turned, linear", glm::dvec2(5.1), -1.0f, 0.0, {kTexels, kTexels}, scenes::TexelFormat::Rgba32Float},
    {"minified to the end", glm::dvec2(40.0)},
    {"odd sides, minified", glm::dvec2(2.3), 0.3f, 0.0, {31, 19}},
    {"slanted, turned, oblong", glm::dvec2(1.1), 0.4f, 62.0, {64, 16}},
};

/// A wall of tiles, each with its own sampler; the texture's corner lies in the middle of each tile.
scenes::Scene wall(const Layout& layout) {
    scenes::Scene scene = quadScene(unlit());
    scene.images = {colourfulImage(layout.sizeTexels, layout.format)};
    scene.nodes.clear();
    scene.materials.clear();
    const glm::dmat4 slanted = glm::rotate(glm::dmat4(1.0), glm::radians(layout.slantDegrees), glm::dvec3(0, 1, 0));
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column) {
            scenes::Material material = unlit();
            scenes::TextureUse& use = material.texture(scenes::TextureSlot::BaseColor);
            use.image = 0;
            use.sampler = {kMagnifying[column % 2], kMinifying[column / 2], kWraps[row], kWraps[(row + column) % 3]};
            const glm::vec2 scale(layout.texelsPerPixel * double(kTilePixels) / double(kTexels));
            const float c = std::cos(layout.turnRadians), s = std::sin(layout.turnRadians);
            use.transform.scale = scale;
            use.transform.rotationRadians = layout.turnRadians;
            const glm::vec2 middle = 0.5f * glm::vec2(c * scale.x + s * scale.y, c * scale.y - s * scale.x);
            use.transform.offset = glm::vec2(0.0313f, 0.0171f) - middle;
            scenes::Node node;
            node.parentFromNode =
                glm::translate(slanted, glm::dvec3(2.0 * column - kColumns + 1.0, kRows - 1.0 - 2.0 * row, 0.0));
            node.instances = {{0, int(scene.materials.size())}};
            scene.nodes.push_back(node);
            scene.materials.push_back(material);
        }
    scenes::Camera& camera = scene.cameras[0];
    if (layout.slantDegrees == 0.0) {
        makeOrthographic(camera, kRows);
    } else {
        camera.worldFromCamera[3] = glm::dvec4(0.0, 0.0, 16.0, 1.0);
        camera.fovYRadians = 1.0;
    }
    return scene;
}

/// The range of values allowed to drivers includes one code step of a texel, up to 2 % of its light; over all pixels
/// such roundings cancel except for those of the smallest levels.
constexpr double kPlainBias = 8e-3;

class TextureFilters : public ImageTest {
protected:
    struct Judged {
        validation::ErrorFigures figures;
        validation::Verdict verdict;
        double plainBias = 0.0; ///< against the reference's value, not the nearest one allowed to drivers
    };
    Judged judged(const scenes::Scene& scene, TextureFilter filter, const shader::SourceTree& shaders = {}) {
        frame::FrameSettings settings = ofSize(kColumns * kTilePixels, kRows * kTilePixels);
        settings.filter = filter;
        engine::Renderer renderer(context(), scene, shaders);
        const Picture shown = engine::toPicture(renderer.render(Technique::Forward, settings));
        const validation::ReferencePicture truth = validation::referencePicture(scene, settings);
        Judged result;
        result.plainBias = validation::errorFigures(shown, truth.picture).bias;
        result.figures = validation::errorFigures(shown, truth.nearestTo(shown),
                                                  validation::shownTriangles(renderer, settings, truth.ids).excluded);
        result.verdict = validation::checkTolerance(result.figures, validation::referenceTolerance(scene, settings));
        return result;
    }
    static std::string tileAt(const validation::ErrorFigures& figures) {
        return fmt::format("tile {}, {}", figures.worstX / kTilePixels, figures.worstY / kTilePixels);
    }
};

/// Texel coordinates on edges: every pixel's centre lies on a corner of four texels, and any of them may be shown.
TEST_F(TextureFilters, pixelsOnTheEdgesOfNearestTexelsShowATexelThatMeetsThere) {
    Layout layout{"on edges", glm::dvec2(2.0)};
    scenes::Scene scene = wall(layout);
    for (scenes::Material& material : scene.materials) {
        scenes::TextureUse& use = material.texture(scenes::TextureSlot::BaseColor);
        use.transform.scale = glm::vec2(2.0f * kTilePixels / kTexels);
        use.transform.offset = glm::vec2(0.0f);
        use.sampler.magnification = use.sampler.minification = Filter::Nearest;
    }
    const Judged found = judged(scene, TextureFilter::Exact);
    EXPECT_TRUE(found.verdict.ok) << testing::PrintToString(found.verdict.missed);
    EXPECT_LT(found.figures.excluded, 0.02); // only the diagonals of the tiles
}

TEST_F(TextureFilters, everyFilterWithEveryWrapModeAgreesWithTheReference) {
    for (const Layout& layout : kLayouts)
        for (const TextureFilter filter : {TextureFilter::Exact, TextureFilter::Hardware}) {
            // A software rasteriser compiles the program for each sampler and format: half a minute for these.
            if (filter == TextureFilter::Hardware && layout.format == scenes::TexelFormat::Rgba32Float) continue;
            SCOPED_TRACE(layout.what);
            const Judged found = judged(wall(layout), filter);
            fmt::print("{:<28} {:<9} p99.9 {:.1e}  relMse {:.1e}  bias {:+.1e}  max {:.1e} at {}\n", layout.what,
                       filter == TextureFilter::Exact ? "exact" : "hardware", found.figures.p999Rel,
                       found.figures.relMse, found.figures.bias, found.figures.maxRel, tileAt(found.figures));
            EXPECT_TRUE(found.verdict.ok) << testing::PrintToString(found.verdict.missed);
            EXPECT_LE(std::abs(found.plainBias), kPlainBias);
        }
}

struct Fault {
    const char* fault;
    TextureFilter filter;
    const char* file; ///< below shaders/
    const char* from;
    const char* to;
};

constexpr Fault kFaults[] = {
    {"no smaller levels", TextureFilter::Hardware, "lib/material/texture_filter.glsl", "texture(image, uv)",
     "textureLod(image, uv, 0.0)"},
    {"a hundredth too bright", TextureFilter::Hardware, "lib/material/texture_filter.glsl", "texture(image, uv)",
     "(1.01 * texture(image, uv))"},
    {"half a level too coarse", TextureFilter::Hardware, "lib/material/texture_filter.glsl", "texture(image, uv)",
     "texture(image, uv, 0.5)"},
    {"half a level too fine", TextureFilter::Hardware, "lib/material/texture_filter.glsl", "texture(image, uv)",
     "texture(image, uv, -0.5)"},
    {"nearest filters blend", TextureFilter::Exact, "lib/material/material_values.glsl",
     "slotUsesNearest(image, slot, fragment, modes)", "false"},
    {"the magnifying filter everywhere", TextureFilter::Exact, "lib/material/texture_filter.glsl",
     "magnified ? TEXTURE_MODE_MAGNIFIES_NEAREST : TEXTURE_MODE_MINIFIES_NEAREST", "TEXTURE_MODE_MAGNIFIES_NEAREST"},
    {"magnified up to level 0 only", TextureFilter::Exact, "lib/material/texture_filter.glsl", "!= 0 ? 2.0 : 1.0",
     "!= 0 ? 1.0 : 1.0"},
};

using TextureFiltersSlow = TextureFilters;

TEST_F(TextureFiltersSlow, aFaultMissesTheReference) {
    // Every level from magnified to minified; and one between the two limits of magnification.
    const scenes::Scene slanted = wall(kLayouts[std::size(kLayouts) - 1]), little = wall(kLayouts[1]);
    for (const Fault& fault : kFaults) {
        SCOPED_TRACE(fault.fault);
        const ShaderMutant shaders(fault.file, fault.from, fault.to);
        const Judged found =
            judged(fault.filter == TextureFilter::Hardware ? slanted : little, fault.filter, shaders.tree());
        EXPECT_FALSE(found.verdict.ok && std::abs(found.plainBias) <= kPlainBias)
            << "p99.9 " << found.figures.p999Rel << ", relMse " << found.figures.relMse;
        fmt::print("{:<36} {}\n", fault.fault,
                   found.verdict.ok ? fmt::format("plain bias {:.1e}", found.plainBias) : found.verdict.missed.front());
    }
}

} // namespace
} // namespace tessera
