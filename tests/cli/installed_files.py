"""What the package tessera puts below /usr besides the program, for the tests of its unpacked and of its installed files."""

import gzip
import pathlib
import shutil
import subprocess
import unittest
import xml.etree.ElementTree

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
# Arguments with which the program prints its installed texts.
TEXTS = (("manual",), ("completion", "bash"), ("completion", "zsh"))

case = unittest.TestCase()


def run(*command, **more):
    result = subprocess.run([str(word) for word in command], text=True, capture_output=True, stdin=subprocess.DEVNULL, timeout=200, **more)
    if result.returncode != 0:
        raise AssertionError(f"{command} ended with {result.returncode}\n{result.stdout}{result.stderr}")
    return result.stdout


def filesOf(folder):
    return {str(path.relative_to(folder)) for path in folder.rglob("*") if not path.is_dir()}


def checkTexts(usr, said):
    """Manual page and completion below `usr` are what the program says: said(WORDS...), for each of TEXTS."""
    page = gzip.decompress((usr / "share/man/man1/tessera.1.gz").read_bytes()).decode()
    case.assertEqual(page, said("manual"))
    bash, (zsh,) = usr / "share/bash-completion/completions/tessera", usr.glob("share/zsh/*/_tessera")
    case.assertEqual(bash.read_text(), said("completion", "bash"))
    case.assertEqual(zsh.read_text(), said("completion", "zsh"))
    case.assertEqual(run("bash", "-c", f"source {bash}; complete -p tessera").strip(), "complete -F _tessera tessera")


def checkDesktop(usr):
    """The desktop finds the program, its icon and its types below `usr`."""
    desktop = usr / "share/applications/tessera.desktop"
    if shutil.which("desktop-file-validate"):
        case.assertEqual(run("desktop-file-validate", desktop), "")
    keys = dict(line.split("=", 1) for line in desktop.read_text().splitlines() if "=" in line)
    case.assertTrue((usr / "bin" / keys["Exec"].split()[0]).is_file())
    icon = usr / f"share/icons/hicolor/scalable/apps/{keys['Icon']}.svg"
    case.assertEqual(xml.etree.ElementTree.parse(icon).getroot().tag, "{http://www.w3.org/2000/svg}svg")
    component = xml.etree.ElementTree.parse(usr / "share/metainfo/tessera.metainfo.xml").getroot()
    case.assertEqual(component.findtext("launchable"), desktop.name)
    case.assertEqual(component.findtext("icon"), keys["Icon"])
    case.assertEqual([kind.text for kind in component.iter("mediatype")], keys["MimeType"].strip(";").split(";"))
    # The viewer's window has the name that the desktop file declares.
    case.assertIn(f'title = "{keys["StartupWMClass"]}"', (REPOSITORY / "renderer/gpu/Context.h").read_text())
