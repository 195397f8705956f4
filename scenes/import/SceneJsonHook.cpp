#include "scenes/import/SceneJsonParts.h"

#include <algorithm>
#include <set>

#include "scenes/Fingerprint.h"
#include "scenes/import/Files.h"

namespace tessera::scenes::scenejson {
namespace {

float valueWithin(const HookParameter& parameter, const JsonValue& number) {
    const float value = number.single();
    if (!parameter.allows(value))
        number.fail("is {:g}, and must lie between its least, {:g}, and its most, {:g}", value, parameter.least,
                    parameter.most);
    return value;
}

HookParameter readHookParameter(const JsonValue& value) {
    JsonObject object = value.object();
    HookParameter parameter;
    const JsonValue name = object.require("name");
    parameter.name = name.text();
    if (!isHookParameterName(parameter.name))
        name.fail("must be a letter and up to 31 letters and digits, and not timeSeconds, which every hook has");
    if (const auto least = object.find("least")) parameter.least = least->single();
    if (const auto most = object.find("most")) parameter.most = most->single();
    const JsonValue number = object.require("value");
    object.done("a parameter of a hook");
    parameter.value = valueWithin(parameter, number);
    return parameter;
}

/// Changes the values of parameters of the base's hook.
void readValues(const JsonValue& values, Scene& scene) {
    if (!scene.hook) values.fail("there is no hook of a base whose parameters it would set; name a 'file'");
    JsonObject object = values.object();
    for (HookParameter& parameter : scene.hook->parameters)
        if (const auto number = object.find(parameter.name)) parameter.value = valueWithin(parameter, *number);
    object.done("the values of a hook");
}

std::vector<int> materialsCalled(const JsonValue& list, const Scene& scene) {
    std::set<int> materials;
    for (const JsonValue& value : list.elements(1)) {
        const std::string name = value.text();
        const std::size_t before = materials.size();
        for (std::size_t i = 0; i < scene.materials.size(); ++i)
            if (scene.materials[i].name == name) materials.insert(int(i));
        if (materials.size() > before) continue;
        if (std::ranges::find(scene.materials, name, &Material::name) != scene.materials.end())
            value.fail("'{}' is in the list already; remove it", name);
        std::vector<std::string_view> names;
        for (const Material& material : scene.materials) names.push_back(material.name);
        value.failUnknown("material", name, names);
    }
    return {materials.begin(), materials.end()};
}

/// Reads the hash and the functions of a hook file. Throws InputError if it is not a hook.
void readFile(const std::filesystem::path& file, LoadLedger& ledger, Hook& hook) {
    const std::uint64_t mark = ledger.usedBytes();
    const std::vector<std::byte> bytes = readFileBytes(file, ledger);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    requireHook(file.string(), text);
    const HookFunctions functions = hookFunctions(text);
    hook.changesSurfaces = functions.surface;
    hook.movesVertices = functions.vertex;
    hook.contentHash = fingerprint(bytes);
    hook.file = file.string();
    ledger.settle(mark, 0);
}

} // namespace

void readHook(const JsonValue& value, Scene& scene, LoadLedger& ledger) {
    if (value.isNull()) return scene.hook.reset();
    JsonObject object = value.object();
    if (const auto values = object.find("values")) {
        object.done("a hook of new values");
        return readValues(*values, scene);
    }
    scene.hook.reset();
    Hook hook;
    const JsonValue file = object.require("file");
    const std::optional<JsonValue> materials = object.find("materials");
    const std::optional<JsonValue> mayMove = object.find("mayMoveMetres");
    if (const auto parameters = object.find("parameters")) {
        for (const JsonValue& parameter : parameters->elements(0, kMostHookParameters)) {
            hook.parameters.push_back(readHookParameter(parameter));
            const auto last = hook.parameters.end() - 1;
            if (std::find_if(hook.parameters.begin(), last,
                             [&](const HookParameter& other) { return other.name == last->name; }) != last)
                parameter.fail("the name '{}' is taken; give another", last->name);
        }
    }
    object.done("a hook");
    if (materials) {
        hook.materials = materialsCalled(*materials, scene);
    } else {
        for (std::size_t i = 0; i < scene.materials.size(); ++i) hook.materials.push_back(int(i));
    }
    const std::filesystem::path path = std::filesystem::absolute(resolveFile(file)).lexically_normal();
    readFile(path, ledger, hook);
    if (hook.movesVertices != mayMove.has_value())
        (mayMove ? *mayMove : value)
            .fail(mayMove ? "the file has no hookVertex, which it would bound; remove it"
                          : "lacks 'mayMoveMetres', as far as its hookVertex moves a vertex at most");
    if (mayMove) hook.mayMoveMetres = double(mayMove->single(0.0));
    scene.hook = std::move(hook);
}

} // namespace tessera::scenes::scenejson
