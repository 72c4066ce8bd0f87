"""What `geometric` needs is there at once: who asks for no weights does not wait for torch."""

import subprocess
import sys


def test_segmenter_and_joints_import_nothing_that_they_do_not_need() -> None:
    heavy = "torch pxr mujoco rerun trimesh"
    code = (
        "import sys\n"
        "from simart_kit_plugins.geometric.predictor import GeometricJoints\n"
        "from simart_kit_plugins.geometric.segmenter import Geometric\n"
        "from simart_kit.testing.meshes import cabinet_mesh\n"
        "mesh = cabinet_mesh()\n"
        "print(len(GeometricJoints().predict(mesh, Geometric().segment(mesh))))\n"
        f"print(sorted(set('{heavy}'.split()) & set(sys.modules)))\n"
    )
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    joints, imported = out.splitlines()
    assert int(joints) > 0
    assert imported == "[]"
