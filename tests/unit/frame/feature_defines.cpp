#include "renderer/frame/FeatureDefines.h"

#include <gmock/gmock.h>

namespace tessera::frame {
namespace {

using scenes::MaterialModel;
using testing::Contains;
using testing::Pair;

TEST(Features, everyFeatureBecomesADefineOfZeroOrOne) {
    const Defines none = featureDefines(FeatureSet{}), all = featureDefines(allFeatures());
    EXPECT_EQ(none.size(), all.size());
    for (const FeatureInfo& info : featureTable()) {
        EXPECT_THAT(none, Contains(Pair("HAS_" + info.define, "0")));
        EXPECT_THAT(all, Contains(Pair("HAS_" + info.define, "1")));
        EXPECT_EQ(&info, &featureTable()[std::size_t(info.feature)]) << "the table follows the enumeration";
        EXPECT_FALSE(info.what.empty() || info.absent.empty());
    }
    for (const char* sum : {"HAS_LIT_MODELS", "HAS_GLOSSY_MODELS", "HAS_MICROSURFACES", "HAS_GGX_MODELS",
                            "HAS_TANGENT_FRAME", "HAS_TANGENTS", "HAS_TEXTURES"}) {
        EXPECT_THAT(none, Contains(Pair(sum, "0")));
        EXPECT_THAT(all, Contains(Pair(sum, "1")));
    }
    FeatureSet sole;
    sole.soleModel = MaterialModel::Microfacet;
    EXPECT_THAT(featureDefines(sole), Contains(Pair("SOLE_MODEL", "3u")));
}

TEST(Features, shadersGetTheNumbersAndClassesOfModels) {
    const Defines none = featureDefines(FeatureSet{}), all = featureDefines(allFeatures());
    for (const Defines& defines : {none, all}) {
        EXPECT_THAT(defines, Contains(Pair("MODEL_COUNT", std::to_string(scenes::kMaterialModelCount) + "u")));
        EXPECT_THAT(defines, Contains(Pair("MODEL_SINGLE_COLOR", "0u")));
        EXPECT_THAT(defines, Contains(Pair("MODEL_METALLIC_ROUGHNESS", "5u")));
        EXPECT_THAT(defines, Contains(Pair("MODEL_FIRST_MICROFACET", "3u")));
    }
    EXPECT_THAT(none, Contains(Pair("LIT_MODELS", "")));
    EXPECT_THAT(none, Contains(Pair("IS_UNLIT(model)", "(false)")));
    EXPECT_THAT(all, Contains(Pair("LIT_MODELS", "1u, 2u, 3u, 4u, 5u")));
    EXPECT_THAT(all, Contains(Pair("IS_UNLIT(model)", "((model) == 0u)")));
    EXPECT_THAT(
        all, Contains(Pair("IS_GLOSSY(model)", "((model) == 2u || (model) == 3u || (model) == 4u || (model) == 5u)")));
    EXPECT_THAT(all, Contains(Pair("HAS_PARAMETER(model)", "((model) == 2u)")));
    EXPECT_THAT(all, Contains(Pair("IS_MICROFACET(model)", "((model) == 3u || (model) == 4u)")));
    FeatureSet one;
    one.add(featureOf(MaterialModel::Microfacet));
    EXPECT_THAT(featureDefines(one), Contains(Pair("IS_MICROFACET(model)", "((model) == 3u)")));
}

} // namespace
} // namespace tessera::frame
