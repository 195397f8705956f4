#include "renderer/shader/HookFault.h"

#include <gmock/gmock.h>

#include "renderer/frame/HookConstants.h"
#include "shaders/shared/hook.h"
#include "tests/support/TempFolder.h"

namespace tessera::shader {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// A program with this hook, on the embedded shaders.
class HookFault : public testing::Test {
protected:
    HookFault() {
        scenes::Hook hook;
        hook.file = folder
                        .write("tint.glsl", "// twice() doubles\n/* glow\n*/\nin float glow;\n"
                                            "float twice(float x) { return twice(2.0 * x); }\n"
                                            "void hookSurface(inout HookedSurface surface, HookInputs inputs)\n{\n"
                                            "    float speed = hook.speed; surface.colour = vec3(speed);\n}\n")
                        .string();
        hook.parameters = {{"red"}, {"green"}};
        desc = {"lit", "a.vert", "a.frag", "", frame::hookDefines(frame::hookShape(hook))};
        file = hook.file;
    }
    std::string said(const std::string& log) const { return hookFaultText(SourceTree::embedded(), desc, log); }

    test::TempFolder folder;
    ProgramDesc desc;
    std::string file;
};

TEST_F(HookFault, whatTheDriverGivesNoPlaceIsNamedByTheLineOfTheHookThatItSpeaksOf) {
    const std::string recursion = "error: function `float twice(float)' has static recursion";
    EXPECT_THAT(said(recursion), StartsWith(file + ":5: the driver refuses this hook: " + recursion +
                                            "\nGLSL has no "
                                            "recursion"));
    EXPECT_THAT(said("error: fragment shader input `glow' has no matching output in the previous stage"),
                StartsWith(file + ":4: the driver refuses this hook: error: fragment"));
    // Quotation marks of NVIDIA and glslang.
    EXPECT_THAT(said("error C9: \"glow\" is not written"), StartsWith(file + ":4: "));
    EXPECT_THAT(said("error: 'glow' : it isn't written, and can't be"), StartsWith(file + ":4: "));
    EXPECT_THAT(said("error: it isn't glow, but `another' or `tw"), StartsWith(file + ": the driver refuses"));
    const std::string whole = said("error: unresolved reference to function `hookVertex'");
    EXPECT_THAT(whole, HasSubstr("write void hookSurface(inout HookedSurface surface, HookInputs inputs), void "
                                 "hookVertex(inout vec3 positionOS, inout vec3 normalOS, vec2 uv) or both"));
    EXPECT_THAT(whole, Not(HasSubstr("HookedSurface has")));
}

TEST_F(HookFault, aFieldThatIsNotThereIsAnsweredByThoseThatAre) {
    const std::string place = file + ":8: error: cannot access field `colour' of structure";
    EXPECT_EQ(said("shaders/passes/a.frag:3: warning: `x' used uninitialized\n" + place),
              file + ": the driver refuses this hook: " + place +
                  "\nHookedSurface has color, emission, alpha, metallic; HookInputs has uv, positionOS, instance; hook "
                  "has timeSeconds, red, green");
    EXPECT_THAT(said(file + ":8: error: 'speed' : no such field in structure 'hook'"), HasSubstr("timeSeconds, red"));
    EXPECT_THAT(said(file + ":8: error: `twice' undeclared"), Not(HasSubstr("HookedSurface has")));
}

TEST_F(HookFault, namesOfTheHookAreAsItsFileHasThemAndTheFilesIsItsOwn) {
    const std::string odd = folder.write("waterproofHook.glsl", "void hookSurface() { glow; }\n").string();
    const ProgramDesc named{"lit", "a.vert", "a.frag", "", {{"HOOK_FILE", odd}}};
    const std::string log = odd + ":1: error: `ofHookglow' undeclared";
    EXPECT_TRUE(namesHook(named, log));
    EXPECT_THAT(hookFaultText(SourceTree::embedded(), named, log),
                StartsWith(odd + ": the driver refuses this hook: " + odd + ":1: error: `glow' undeclared"));
}

TEST_F(HookFault, onlyErrorsWithinTheHookNameIt) {
    EXPECT_TRUE(namesHook(desc, "shaders/a.frag:3: warning: w\n" + file + ":1: error: e"));
    EXPECT_FALSE(namesHook(desc, "shaders/a.frag:3: error: e\n" + file + ":1: warning: w"));
    EXPECT_EQ(hookFileOf(desc), file);
    EXPECT_EQ(hookFileOf({"plain", "a.vert", "a.frag", "", {}}), "");
}

/// An empty hook is a valid hook, and no text of the scene's hook is left in the program.
TEST_F(HookFault, aProgramWithAnEmptyHookHoldsNothingOfTheScenes) {
    ProgramDesc query = withEmptyHook(desc);
    query.vertex.clear();
    query.fragment.clear();
    query.compute = "passes/hook_surfaces.comp";
    const std::vector<ExpandedStage> stages = expandStages(SourceTree::embedded(), query);
    ASSERT_EQ(stages.size(), 1u);
    EXPECT_THAT(stages[0].source.text, HasSubstr("hookSurface(inout HookedSurface surface, HookInputs inputs) {}"));
    EXPECT_THAT(stages[0].source.text, Not(HasSubstr("float red;")));
    EXPECT_THAT(stages[0].source.text, Not(HasSubstr("twice")));
}

} // namespace
} // namespace tessera::shader
