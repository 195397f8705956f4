// NaN, the result of loops that Mesa truncates after 65,535 iterations in total: NaN is visible, missing light is not.
#pragma once

// A test for a truncated loop compares the loop's counter by `!=`. Mesa infers from the loop that its own condition is
// false behind it, and would leave out a test by that condition.
#define CUT_LOOP uintBitsToFloat(0x7FC00000u)

// Whether the driver's iteration limit is reached: then every further loop ends after its first iteration. `place` is
// never negative; compilers do not know that, so they cannot unroll the loop.
bool loopsAreCut(int place)
{
    int most = place < 0 ? 3 : 2;
    float rounds = 0.0;
    for (int i = 0; i < most; ++i) rounds += 1.0;
    return rounds < 1.5;
}
