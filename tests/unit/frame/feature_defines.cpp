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

} // namespace
} // namespace tessera::frame
