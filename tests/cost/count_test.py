"""The count sees what is added to a program, and nothing else."""

import unittest

import count

LOG = """(
(declare (location=2 shader_out ) vec4 gl_FragColor)
)
shader: MESA_SHADER_FRAGMENT
name: GLSL1
label: gbuffer [HAS_LAMBERT=1]
decl_function main (0 params)

impl main {
	block block_0:
	/* preds: */
	vec1 32 ssa_0 = load_const (0x00000000 = 0.000000)
	vec4 32 ssa_1 = (float32)txf ssa_2 (coord), ssa_0 (lod), 0 (texture), 0 (sampler)
	vec4 32 ssa_3 = intrinsic load_ubo (ssa_0, ssa_0) (access=0)
	loop {
		block block_1:
		vec1 32 ssa_4 = fdiv! ssa_1.x, ssa_3.x
		if ssa_5 {
			break
		} else {
		}
	}
	intrinsic store_deref (ssa_2, ssa_3) (wrmask=xyzw /*15*/, access=0)
	/* succs: block_2 */
}


(
(declare (uniform ) vec4 other)
)
tessera: a line of another kind
"""


class Count(unittest.TestCase):
    def testInstructionsCountByWhatTheyCost(self):
        self.assertEqual(count.countsOf(LOG), {
            "gbuffer.fragment": {"instructions": 4, "slow": 1, "loads": 1, "textures": 1, "branches": 2}})

    def testATableIsReadAsItIsWritten(self):
        rows = {("hall", "gbuffer.fragment"): dict.fromkeys(count.COLUMNS, 7)}
        self.assertEqual(count.tableIn(count.textOf("llvmpipe", rows)), ("llvmpipe", rows))

    def testMoreThanThreePercentOfAnyColumnIsAFaultAndLessIsNone(self):
        def rows(instructions, textures=20):
            return {("hall", "gbuffer.fragment"): {**dict.fromkeys(count.COLUMNS, 0), "instructions": instructions, "textures": textures}}

        self.assertEqual(count.faultsOf(rows(1000), rows(1030)), [])
        self.assertEqual(count.faultsOf(rows(1000), rows(1031)), ["hall gbuffer.fragment: instructions 1000 -> 1031 (+3.1%)"])
        self.assertEqual(len(count.faultsOf(rows(1000), rows(969))), 1)
        self.assertEqual(count.faultsOf(rows(1000), rows(1001, 21)), ["hall gbuffer.fragment: textures 20 -> 21 (+5.0%)"])
        self.assertEqual(count.faultsOf(rows(1), {}), ["hall gbuffer.fragment: is in the table alone"])
        self.assertEqual(count.faultsOf({}, rows(1)), ["hall gbuffer.fragment: is not in the table"])


if __name__ == "__main__":
    unittest.main()
