#include "scenes/Clips.h"

#include "base/Error.h"
#include "scenes/Fingerprint.h"
#include "scenes/Pose.h"
#include "tests/unit/scenes/RiggedScene.h"
#include "tests/unit/scenes/TempFolder.h"

namespace tessera::scenes {
namespace {

TEST(Clips, areChosenByNameThenByNumber) {
    Scene scene = riggedScene();
    scene.rig.clips.push_back(scene.rig.clips[0]);
    scene.rig.clips[1].name = "0";
    playClip(scene, "0");
    EXPECT_EQ(scene.rig.playing, std::vector{1});
    EXPECT_EQ(clipText(scene), "clip 1 '0' (of 0 to 1), 1 s");
    playClip(scene, "bend");
    EXPECT_EQ(scene.rig.playing, std::vector{0});
    playClip(scene, "1");
    EXPECT_EQ(scene.rig.playing, std::vector{1});
    playClip(scene, "none");
    EXPECT_FALSE(isPlaying(scene));
    EXPECT_EQ(clipText(scene), "no clip of 2");
    EXPECT_THAT(test::inputErrorOf([&] { playClip(scene, "bent"); }), testing::HasSubstr("did you mean 'bend'"));
}

TEST(Clips, thoseWithoutDurationAreCalledPoses) {
    Scene scene = riggedScene();
    Clip& clip = scene.rig.clips.at(0);
    for (AnimationSampler& sampler : clip.samplers) {
        sampler.timesSeconds = {0.0f};
        sampler.values.resize(sampler.valuesPerKey() * std::size_t(sampler.width));
    }
    playClip(scene, "0");
    EXPECT_EQ(clipText(scene), "clip 0 'bend' (the only one), a pose without duration");
    clip.channels.clear();
    EXPECT_EQ(clipText(scene), "clip 0 'bend' (the only one), which moves nothing");
}

TEST(Clips, aSceneWithoutAnyHasNoPoses) {
    Scene scene = tinyScene();
    const std::uint64_t before = fingerprint(scene);
    EXPECT_FALSE(hasPoses(scene));
    EXPECT_EQ(clipText(scene), "");
    EXPECT_NO_THROW(playClip(scene, "none"));
    poseScene(scene, 3.0);
    EXPECT_EQ(fingerprint(scene), before);
}

TEST(Clips, theyPlayAsLongAsTheLongestOfThem) {
    Scene scene = riggedScene();
    Clip& longer = scene.rig.clips.emplace_back(scene.rig.clips[0]);
    longer.samplers[1].timesSeconds[1] = 2.5f;
    EXPECT_EQ(playingSeconds(scene.rig), 1.0);
    scene.rig.playing = {0, 1};
    EXPECT_EQ(playingSeconds(scene.rig), 2.5);
    playClip(scene, "none");
    EXPECT_EQ(playingSeconds(scene.rig), 0.0);
}

} // namespace
} // namespace tessera::scenes
