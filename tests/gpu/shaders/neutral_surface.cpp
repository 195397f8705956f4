// The neutral surface: the values of channels that the G-buffer lacks.
#include <gtest/gtest.h>

#include "shaders/shared/models.h"
#include "tests/gpu/gbuffer/GBufferTest.h"

namespace tessera {
namespace {

class NeutralSurface : public test::GlTest {
protected:
    test::ShaderBench bench;
};

TEST_F(NeutralSurface, itEmitsAndReflectsNothingWhateverItWasBefore) {
    const std::vector<glm::vec4> befores{glm::vec4(0.0f), glm::vec4(3.0f), glm::vec4(1e9f)};
    const std::vector<glm::vec4> out =
        bench.run("test/neutral_surface.comp", test::kEveryMember, befores, befores.size(), 8);
    for (std::size_t i = 0; i < befores.size(); ++i) {
        SCOPED_TRACE(befores[i].x);
        const glm::vec4* of = &out[8 * i];
        EXPECT_EQ(of[0], glm::vec4(0.0f)) << "albedo, metallic";
        EXPECT_EQ(of[1], glm::vec4(0, 0, 1, 1)) << "a unit normal, alpha 1";
        EXPECT_EQ(of[2], glm::vec4(0, 0, 0, 1)) << "no specular; F90 of 1, as glTF has it";
        EXPECT_EQ(of[3], glm::vec4(0, 0, 0, float(scenes::MaterialModel::SingleColor))) << "emission, model";
        EXPECT_EQ(of[4], glm::vec4(0.5f, 0.5f, 1.0f, 0.0f)) << "a flat normal map, exponent";
        EXPECT_NEAR(glm::length(glm::vec3(of[5])), 1.0f, 1e-6f) << "the tangent";
        EXPECT_EQ(of[6].z, 0.0f) << "no coat";
        EXPECT_EQ(of[7], glm::vec4(0, 0, 0, 1)) << "no sheen";
    }
}

} // namespace
} // namespace tessera
