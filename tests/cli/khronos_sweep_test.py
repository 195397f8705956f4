"""khronos_sweep_test.py PROGRAM: every glTF model of the folder that TESSERA_ASSETS names is drawn by the program and
does not crash; it is not black, and in the camera that the program supplies, by itself or by --default-camera in the
place of the model's own, it fills the picture without being cut off.
What docs/khronos-models.md says is drawn is. Skipped (77) without the folder."""

import os
import pathlib
import sys
import tempfile

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "tools"))
import khronos_models as tool  # noqa: E402

SIZE = "240x136"  # the default camera's margin at each side is then three pixels of the height


def main():
    assets = os.environ.get("TESSERA_ASSETS", "")
    if not assets or not tool.models_below(pathlib.Path(assets)):
        print("TESSERA_ASSETS names no folder of glTF models")
        return 77
    with tempfile.TemporaryDirectory() as output:
        expected = ["--expect", str(REPOSITORY / "docs/khronos-models.md")]
        return tool.main([assets, output, "--program", sys.argv[1], "--size", SIZE, *expected])


if __name__ == "__main__":
    sys.exit(main())
