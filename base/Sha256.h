#pragma once
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace tessera {

using Sha256Digest = std::array<std::byte, 32>;

/// Incremental SHA-256 by libcrypto, which uses the processor's SHA instructions: a map of 2048 columns has 32 MB.
/// Source: NIST, FIPS 180-4.
class Sha256 {
public:
    Sha256();
    ~Sha256();
    Sha256(const Sha256&) = delete;
    Sha256& operator=(const Sha256&) = delete;

    void add(std::span<const std::byte> bytes);
    Sha256Digest digest(); ///< call once

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// 64 lower-case hexadecimal digits.
std::string hexadecimal(const Sha256Digest& digest);

} // namespace tessera
