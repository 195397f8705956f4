#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/Error.h"
#include "renderer/shader/ProgramDesc.h"
#include "tests/support/TempFolder.h"

namespace tessera::shader {
namespace {

TEST(ProgramDesc, theKeyNeverDependsOnTheOrderOfTheDefines) {
    const ProgramDesc a{"light", "v", "f", "", {{"A", "1"}, {"B", ""}}};
    const ProgramDesc b{"light", "v", "f", "", {{"B", ""}, {"A", "1"}}};
    EXPECT_EQ(a.key(), b.key());
    EXPECT_EQ(a.key(), "light|v|f|||A=1;B=");
}

TEST(ProgramDesc, differentVariantsHaveDifferentKeys) {
    const ProgramDesc base{"light", "v", "f", "", {{"A", "1"}}};
    ProgramDesc other = base;
    other.defines = {{"A", "2"}};
    EXPECT_NE(base.key(), other.key());
    other = base;
    other.fragment = "g";
    EXPECT_NE(base.key(), other.key());
    EXPECT_NE(base, other);
}

TEST(ProgramDesc, everyStageGetsTheDefines) {
    test::TempFolder folder;
    folder.write("a.vert", "void main() {}\n");
    folder.write("a.frag", "void main() {}\n");
    const SourceTree tree(folder.path());
    const auto stages = expandStages(tree, {"p", "a.vert", "a.frag", "", {{"A", "1"}}});
    ASSERT_EQ(stages.size(), 2u);
    EXPECT_EQ(stages[0].stage, gpu::Stage::Vertex);
    EXPECT_EQ(stages[1].stage, gpu::Stage::Fragment);
    for (const ExpandedStage& stage : stages) EXPECT_THAT(stage.source.text, testing::HasSubstr("#define A 1\n"));
}

TEST(ProgramDesc, aSenselessSetOfStagesIsRefused) {
    const SourceTree tree = SourceTree::embedded();
    for (const ProgramDesc& desc : {ProgramDesc{"p", "", "", "", {}}, ProgramDesc{"p", "", "f", "", {}},
                                    ProgramDesc{"p", "v", "", "c", {}}, ProgramDesc{"p", "", "f", "c", {}}})
        EXPECT_THROW(expandStages(tree, desc), InputError) << desc.key();
}

} // namespace
} // namespace tessera::shader
