#include "tests/unit/scenes/obj/ObjFiles.h"

namespace tessera::scenes {
namespace {

using namespace test;

class ObjVertexColours : public ObjFiles {
protected:
    Scene coloured(const char* first, const char* second, const char* third,
                   const ImportOptions& importOptions = {}) const {
        return importText(std::string("v 0 0 0") + first + "\nv 1 0 0" + second + "\nv 0 1 0" + third + "\nf 1 2 3\n",
                          importOptions);
    }
    static glm::vec4 firstColour(const Scene& scene) { return scene.meshes.at(0).colors.at(0); }
};

TEST_F(ObjVertexColours, areSrgbUnlessLinearOnesAreRequested) {
    constexpr const char* kHalf = " 0.73535698 1 0"; // 0.5 in linear light, by IEC 61966-2-1
    const Scene scene = coloured(kHalf, kHalf, kHalf);
    EXPECT_NEAR(firstColour(scene).x, 0.5f, 1e-6f); // rounding of the text
    EXPECT_EQ(firstColour(scene).y, 1.0f);
    EXPECT_EQ(firstColour(scene).z, 0.0f);
    EXPECT_EQ(firstColour(scene).w, 1.0f);
    EXPECT_THAT(scene.warnings, IsEmpty());
    ImportOptions linear;
    linear.objColours = ObjColours::Linear;
    EXPECT_EQ(firstColour(coloured(kHalf, kHalf, kHalf, linear)).x, 0.73535698f);
}

TEST_F(ObjVertexColours, inBytesAreDividedBy255) {
    const Scene scene = coloured(" 188 0 1", " 255 255 255", "");
    ASSERT_EQ(scene.warnings.size(), 2u);
    EXPECT_THAT(scene.warnings[1], HasSubstr("model.obj:1: colours of vertices are up to 255, not 0 to 1; they "
                                             "are divided by 255"));
    EXPECT_NEAR(firstColour(scene).x, 0.5029f, 1e-4f); // the byte 188
    EXPECT_EQ(scene.meshes[0].colors.at(2), glm::vec4(1.0f)) << "white where there is none";
}

TEST_F(ObjVertexColours, thatAreMissingAreWhite) {
    for (const char* missing : {"", " 1 0", " nan 0 0", " x 0 0"}) {
        const Scene scene = coloured(missing, " 0 0 0", " 0 0 0");
        EXPECT_THAT(onlyWarning(scene), HasSubstr("1 of 3 vertices have no colour")) << missing;
        EXPECT_EQ(firstColour(scene), glm::vec4(1.0f)) << missing;
    }
    EXPECT_TRUE(importText("v 5 5 5 1 0 0\n" + std::string(kThreeVertices) + "f 2 3 4\n", strictly())
                    .meshes.at(0)
                    .colors.empty())
        << "no used vertex has one";
}

TEST_F(ObjVertexColours, outOfRangeAreClamped) {
    const Scene scene = coloured(" 1.5 -0.5 0", " 0 0 0", " 0 0 0");
    EXPECT_EQ(onlyWarning(scene),
              "model.obj: the colour 1.5 -0.5 0 of vertex 1 is not within 0 to 1; the nearest bound is taken");
    EXPECT_EQ(firstColour(scene), glm::vec4(1, 0, 0, 1));
}

} // namespace
} // namespace tessera::scenes
