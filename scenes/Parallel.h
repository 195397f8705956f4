#pragma once
#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace tessera::scenes {

/// Calls body(i) once for every i in 0..count-1, on all cores; the calls must not depend on each other and must not
/// throw.
template <typename Body>
void parallelFor(int count, const Body& body) {
    std::atomic<int> next = 0;
    const auto work = [&] {
        for (int i = next++; i < count; i = next++) body(i);
    };
    const int helpers = std::min(count, static_cast<int>(std::thread::hardware_concurrency())) - 1;
    std::vector<std::jthread> threads;
    for (int t = 0; t < helpers; ++t) threads.emplace_back(work);
    work();
}

} // namespace tessera::scenes
