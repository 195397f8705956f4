// Parts of an environment on the GPU, each created when it is first requested.
#include "renderer/frame/EnvironmentMap.h"

#include "scenes/builtin/Pictures.h"
#include "tests/support/GlContext.h"

namespace tessera::frame {
namespace {

class EnvironmentParts : public test::GlTest {
protected:
    const scenes::Environment environment{"test", scenes::builtin::drawRadiance("test", 16, 8, [](int x, int y) {
                                              return glm::dvec3(x == 3 && y == 2 ? 100.0 : 0.25 * x, 0.5, y);
                                          })};
};

TEST_F(EnvironmentParts, theMapAloneHoldsTheRadianceAndNoDensities) {
    EnvironmentGpu parts(environment);
    // The map's texels, with their opacity where environmentTexels() has a density.
    EXPECT_EQ(parts.map().downloadAs<glm::vec4>(), latitudeMapOf(environment.map).texels);
}

TEST_F(EnvironmentParts, samplesBringTheirDensitiesIntoTheMapThatIsThere) {
    std::vector<double> summed;
    const LatitudeMap expected = environmentTexels(environment.map, summed);
    const std::vector<glm::vec4> samples = makeEnvironmentSamples(expected, summed);
    for (const bool mapFirst : {true, false}) {
        EnvironmentGpu parts(environment);
        const gpu::Texture* const before = mapFirst ? &parts.map() : nullptr;
        EXPECT_EQ(parts.samples().downloadAs<glm::vec4>(samples.size()), samples) << mapFirst;
        EXPECT_EQ(parts.map().downloadAs<glm::vec4>(), expected.texels) << mapFirst;
        EXPECT_TRUE(!mapFirst || &parts.map() == before) << "frames may hold it";
    }
}

} // namespace
} // namespace tessera::frame
