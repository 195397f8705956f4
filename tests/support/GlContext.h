#pragma once
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "renderer/gpu/Context.h"
#include "renderer/gpu/Debug.h"

namespace tessera::test {

/// The only context of a test program, created at its first use and destroyed before the program ends. It keeps its
/// programs: compiling them is most of the cost of small images, and tests with separate renderers share them.
class GlEnvironment final : public testing::Environment {
public:
    static gpu::Context& context() {
        if (!instance()) {
            instance() = gpu::Context::create();
            instance()->keepPrograms();
        }
        instance()->makeCurrent();
        return *instance();
    }
    void TearDown() override {
        if (instance()) context().forgetPrograms();
        instance().reset();
    }

private:
    static std::unique_ptr<gpu::Context>& instance() {
        static std::unique_ptr<gpu::Context> context;
        return context;
    }
};
inline testing::Environment* const kGlEnvironment = testing::AddGlobalTestEnvironment(new GlEnvironment);

/// A test with a current context. Fails if it leaves an unreported driver message of high or medium severity; a GPU's
/// performance advice does not count.
class GlTest : public testing::Test {
protected:
    void TearDown() override {
        EXPECT_NO_THROW(gpu::throwIfFailed("after the test"));
        const std::vector<std::string> advice = context_->debugLog().takeWarnings();
        if (!context_->capabilities().isSoftware) return;
        for (const std::string& warning : advice) ADD_FAILURE() << warning;
    }
    gpu::Context& context() { return *context_; }

private:
    gpu::Context* context_ =
        &GlEnvironment::context(); ///< initialised before members of test classes, which may need it
};

} // namespace tessera::test
