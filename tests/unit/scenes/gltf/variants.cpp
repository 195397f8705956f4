// Variants of materials: KHR_materials_variants.

#include "tests/unit/scenes/gltf/GltfBuilder.h"

namespace tessera::scenes::gltf::test {
namespace {

/// Two triangles of the material paint; the first one has ruby in the variant 'red' and sky in 'blue'.
Builder withVariants() {
    Builder builder;
    builder.merge(R"({"extensionsUsed": ["KHR_materials_variants"],
        "extensions": {"KHR_materials_variants": {"variants": [{"name": "red"}, {"name": "blue"}]}},
        "materials": [{"name": "paint"}, {"name": "sky"}, {"name": "ruby"}]})");
    builder.primitive()["material"] = 0;
    builder.json["meshes"][0]["primitives"].push_back(builder.primitive());
    builder.primitive()["extensions"]["KHR_materials_variants"]["mappings"] =
        Json::parse(R"([{"material": 2, "variants": [0]}, {"material": 1, "variants": [1]}])");
    return builder;
}

/// The names of the materials of the first node's instances.
std::vector<std::string> worn(const Scene& scene) {
    std::vector<std::string> names;
    for (const MeshInstance& instance : scene.nodes.at(0).instances)
        names.push_back(scene.materials.at(std::size_t(instance.material)).name);
    return names;
}

TEST(GltfVariants, aVariantBindsItsMaterialsAndKeepsTheNumbersOfOthers) {
    using Names = std::vector<std::string>;
    Builder builder = withVariants();
    const Scene plain = builder.import();
    EXPECT_EQ(plain.variants, (Names{"red", "blue"}));
    EXPECT_EQ(worn(plain), (Names{"paint", "paint"}));
    EXPECT_EQ(plain.materials.size(), 1u) << "what is not shown is not read";
    EXPECT_TRUE(plain.warnings.empty());
    EXPECT_EQ(plain.notes, (Names{"shows its materials as they are without a variant; its variants are red, blue"}));
    builder.importOptions.variant = "blue";
    const Scene blue = builder.import();
    EXPECT_EQ(worn(blue), (Names{"sky", "paint"}));
    EXPECT_EQ(blue.materials.at(0).name, "paint");
    EXPECT_EQ(blue.notes, (Names{"shows the variant 'blue'; its variants are red, blue"}));
    builder.importOptions.variant = "green"; // a variant of another model in the scene
    EXPECT_EQ(worn(builder.import()), (Names{"paint", "paint"}));
}

TEST(GltfVariants, skinnedAndMorphedMeshesShowThemToo) {
    Builder builder = withVariants();
    builder.primitive()["targets"] = Json::parse(R"([{"POSITION": 0}])");
    builder.json["meshes"][0]["primitives"].erase(1);
    builder.json["meshes"][0]["weights"] = {0.5};
    builder.importOptions.variant = "red";
    EXPECT_EQ(worn(builder.import()), (std::vector<std::string>{"ruby"}));
}

TEST(GltfVariants, whatIsNotThereIsRefused) {
    Builder builder = withVariants();
    builder.primitive()["extensions"]["KHR_materials_variants"]["mappings"][0]["variants"][0] = 2;
    EXPECT_THAT(builder.error(),
                HasSubstr("/variants/0: points at /extensions/KHR_materials_variants/variants/2, but there are only 2"))
        << builder.error();
}

} // namespace
} // namespace tessera::scenes::gltf::test
