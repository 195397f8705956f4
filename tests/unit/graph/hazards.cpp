#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <optional>

#include "Frames.h"
#include "tests/support/Random.h"

namespace tessera::graph::test {
namespace {

/// Properties of an access by OpenGL's memory model (OpenGL 4.5 core specification, section 7.13.2), stated
/// independently of the rules under test.
struct Model {
    bool stores;   ///< by a shader, which GL does not order
    bool fetches;  ///< by a shader or the pipeline in front of it
    unsigned bits; ///< barriers that make earlier stores visible to it
};

unsigned bitsOf(Barrier barrier) {
    return unsigned(barrier);
}

Model modelOf(Access access) {
    const unsigned transfer = bitsOf(Barrier::TransferOrUpdate) | bitsOf(Barrier::Framebuffer);
    switch (access) {
    case Access::Sampled:
    case Access::TexelRead:
        return {false, true, bitsOf(Barrier::TextureFetch)};
    case Access::ColorAttachment:
    case Access::DepthAttachment:
        return {false, false, bitsOf(Barrier::Framebuffer)};
    case Access::DepthTest: // may be sampled as well
        return {false, true, bitsOf(Barrier::Framebuffer) | bitsOf(Barrier::TextureFetch)};
    case Access::ImageRead:
        return {false, true, bitsOf(Barrier::ShaderImage)};
    case Access::ImageWrite:
        return {true, false, bitsOf(Barrier::ShaderImage)};
    case Access::UniformRead:
        return {false, true, bitsOf(Barrier::Uniform)};
    case Access::StorageRead:
        return {false, true, bitsOf(Barrier::ShaderStorage)};
    case Access::StorageWrite:
        return {true, false, bitsOf(Barrier::ShaderStorage)};
    case Access::VertexRead:
        return {false, true, bitsOf(Barrier::VertexAttribute)};
    case Access::IndexRead:
        return {false, true, bitsOf(Barrier::ElementArray)};
    case Access::IndirectRead:
        return {false, true, bitsOf(Barrier::Command)};
    case Access::Download:
    case Access::Upload:
        break;
    }
    return {false, false, transfer};
}

constexpr unsigned kEveryBit = (1u << 9) - 1;

/// Brute-force history of a frame: accesses of each pass to memory, and the barrier bits before each pass.
class History {
public:
    History(const Graph& graph, const CompiledGraph& compiled) : graph_(graph), compiled_(compiled) {}

    /// The bits of `wanted` that no barrier has issued after the pass at `from`, up to the one at `to`.
    unsigned pending(unsigned wanted, int from, int to) const {
        for (int position = from + 1; position <= to; ++position)
            wanted &= ~bitsOf(compiled_.order[std::size_t(position)].before);
        return wanted;
    }

    /// Returns the barrier bits that the pass at a position needs.
    unsigned needed(int position) const {
        unsigned bits = 0;
        for (const Graph::Use& use : usesAt(position)) {
            const Model model = modelOf(use.access);
            const std::optional<int> stored = latest(use.resource, position, &Model::stores);
            if (stored) bits |= pending(model.bits, *stored, position - 1);
            if (!model.stores) continue;
            // An earlier frame may have fetched from this memory, so there is always something to wait for.
            const int fetched = latest(use.resource, position, &Model::fetches).value_or(-1);
            bits |= pending(model.bits, fetched, position - 1);
        }
        return bits;
    }

    /// Returns the barrier bits that the next frame needs.
    unsigned neededAfter() const {
        const int end = int(compiled_.order.size());
        unsigned bits = 0;
        for (std::uint32_t resource = 0; resource < graph_.resources().size(); ++resource)
            if (const std::optional<int> stored = latest(resource, end, &Model::stores))
                bits |= pending(kEveryBit, *stored, end - 1);
        return bits;
    }

    const std::vector<Graph::Use>& usesAt(int position) const {
        return graph_.passes()[compiled_.order[std::size_t(position)].pass].uses;
    }

private:
    bool sharesMemory(std::uint32_t a, std::uint32_t b) const {
        return a == b || (compiled_.resources[a].physical >= 0 &&
                          compiled_.resources[a].physical == compiled_.resources[b].physical);
    }

    /// Returns the latest pass before a position whose access to a resource's memory has the property `deed`.
    std::optional<int> latest(std::uint32_t resource, int before, bool Model::*deed) const {
        for (int position = before - 1; position >= 0; --position)
            for (const Graph::Use& use : usesAt(position))
                if (modelOf(use.access).*deed && sharesMemory(use.resource, resource)) return position;
        return std::nullopt;
    }

    const Graph& graph_;
    const CompiledGraph& compiled_;
};

/// A random frame with all accesses: transients that may share memory, growable ones, imports and persistent ones.
class RandomFrame {
public:
    explicit RandomFrame(std::uint64_t seed) : random_(seed) {
        for (const char* name : {"image in", "image in 2"}) textures_.push_back(graph.import(name, kColor));
        for (const char* name : {"buffer in", "buffer in 2"}) buffers_.push_back(graph.import(name, kBytes));
        depths_.push_back(graph.import("depth in", kDepth));
        textures_.push_back(graph.persist("history", kColor, 1));
        const int passes = 3 + random_.index(14);
        for (int i = 0; i < passes; ++i) addPass(std::to_string(i));
        for (const TextureHandle texture : textures_)
            if (random_.index(5) == 0) graph.output(texture);
        for (const BufferHandle buffer : buffers_)
            if (random_.index(5) == 0) graph.output(buffer);
    }

    Graph graph{[](const std::string&, const ResourceDesc&, std::uint64_t) { return true; }};

private:
    template <std::size_t kCount>
    Access oneOf(const Access (&accesses)[kCount]) {
        return accesses[random_.index(int(kCount))];
    }

    void addPass(const std::string& name) {
        declare(graph, name, [&](PassBuilder& builder) {
            if (random_.index(3) == 0) builder.keep();
            const int uses = 1 + random_.index(4);
            std::vector<std::uint32_t> used;
            for (int i = 0; i < uses; ++i) addUse(builder, used);
        });
    }

    /// Adds a use of a resource that the pass does not use yet.
    void addUse(PassBuilder& builder, std::vector<std::uint32_t>& used) {
        const int kind = random_.index(8);
        if (kind == 0) {
            useDepth(builder, used);
        } else if (kind < 4) {
            if (TextureHandle* const texture = unused(textures_, used)) use(builder, *texture);
        } else if (kind < 7) {
            if (BufferHandle* const buffer = unused(buffers_, used)) use(builder, *buffer);
        } else if (random_.index(2) == 0) {
            textures_.push_back(
                builder.create("image", kColor, oneOf({Access::ColorAttachment, Access::ImageWrite, Access::Upload})));
            used.push_back(textures_.back().resource);
        } else {
            const BufferDesc desc{256, random_.index(4) == 0};
            buffers_.push_back(builder.create("buffer", desc, oneOf({Access::StorageWrite, Access::Upload})));
            used.push_back(buffers_.back().resource);
        }
    }

    template <typename HandleType>
    HandleType* unused(std::vector<HandleType>& handles, std::vector<std::uint32_t>& used) {
        HandleType& handle = handles[std::size_t(random_.index(int(handles.size())))];
        if (std::find(used.begin(), used.end(), handle.resource) != used.end()) return nullptr;
        used.push_back(handle.resource);
        return &handle;
    }

    void use(PassBuilder& builder, TextureHandle& texture) {
        const TextureHandle before = texture;
        if (random_.index(2) == 0)
            builder.read(before, oneOf({Access::Sampled, Access::ImageRead, Access::Download}));
        else
            texture = builder.write(before, oneOf({Access::ColorAttachment, Access::ImageWrite, Access::Upload}));
    }

    void use(PassBuilder& builder, BufferHandle& buffer) {
        const BufferHandle before = buffer;
        const int kind = random_.index(3);
        if (kind == 0) { // loads and stores
            builder.read(before, Access::StorageRead);
            buffer = builder.write(before, Access::StorageWrite);
        } else if (kind == 1) {
            buffer = builder.write(before, oneOf({Access::StorageWrite, Access::Upload}));
        } else {
            builder.read(before, oneOf({Access::UniformRead, Access::StorageRead, Access::TexelRead, Access::VertexRead,
                                        Access::IndexRead, Access::IndirectRead, Access::Download}));
        }
    }

    /// Uses a depth texture; a framebuffer has one, so a pass uses no other.
    void useDepth(PassBuilder& builder, std::vector<std::uint32_t>& used) {
        for (const TextureHandle depth : depths_)
            if (std::find(used.begin(), used.end(), depth.resource) != used.end()) return;
        TextureHandle& depth = *unused(depths_, used);
        if (random_.index(2) == 0)
            builder.read(depth, oneOf({Access::Sampled, Access::DepthTest, Access::Download}));
        else
            depth = builder.write(depth, oneOf({Access::DepthAttachment, Access::Upload}));
    }

    tessera::test::Random random_;
    std::vector<TextureHandle> textures_, depths_;
    std::vector<BufferHandle> buffers_;
};

TEST(Hazards, everyBarrierIsExactlyWhatAnOracleOfTheMemoryModelRequires) {
    std::map<Access, int> waited; ///< how often an access had something to wait for
    int aliased = 0, culled = 0, after = 0;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        const RandomFrame frame(seed);
        for (const CompileOptions options : {CompileOptions{true, true}, CompileOptions{true, false},
                                             CompileOptions{false, true}, CompileOptions{false, false}}) {
            SCOPED_TRACE(testing::Message()
                         << "seed " << seed << ", cull " << options.cull << ", alias " << options.alias);
            const CompiledGraph compiled = compile(frame.graph, options);
            const History history(frame.graph, compiled);
            for (int position = 0; position < int(compiled.order.size()); ++position) {
                const unsigned issued = bitsOf(compiled.order[std::size_t(position)].before);
                ASSERT_EQ(issued, history.needed(position)) << "at position " << position;
                for (const Graph::Use& use : history.usesAt(position))
                    waited[use.access] += (issued & modelOf(use.access).bits) != 0;
            }
            ASSERT_EQ(bitsOf(compiled.after), history.neededAfter());
            for (const CompiledResource& resource : compiled.resources) aliased += resource.aliasOf >= 0;
            culled += int(compiled.culled.size());
            after += compiled.after != Barrier::None;
        }
    }
    // Otherwise the comparison means little.
    EXPECT_GT(aliased, 100);
    EXPECT_GT(culled, 100);
    EXPECT_GT(after, 100);
    for (const Access access :
         {Access::Sampled, Access::ColorAttachment, Access::ImageRead, Access::ImageWrite, Access::UniformRead,
          Access::StorageRead, Access::StorageWrite, Access::TexelRead, Access::VertexRead, Access::IndexRead,
          Access::IndirectRead, Access::Download, Access::Upload})
        EXPECT_GT(waited[access], 20) << int(access);
}

} // namespace
} // namespace tessera::graph::test
