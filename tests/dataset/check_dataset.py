"""Reads what write_dataset wrote with OpenCV, json and tarfile, and compares it with the numbers that went in."""
import json
import pathlib
import sys
import tarfile

import cv2
import numpy as np

KEYS = [f"00001{i}" for i in range(7)]
UNSEEN = "000015"


def labels(folder, key):
    return json.loads((folder / f"{key}.json").read_text())


def numbers(folder, key, height, width):
    values = np.fromfile(folder / f"{key}.bin", np.float32)
    planes = values[:4 * height * width].reshape(4, height, width)
    return dict(zip(("part", "vein", "water", "depth"), planes)), values[4 * height * width:].reshape(height, width, 3)


def check_maps(folder, key):
    """Every PNG has the depth that is said, and its values are the numbers by the formula of label_files.hpp."""
    about = labels(folder, key)
    height, width = about["height"], about["width"]
    maps, normals = numbers(folder, key, height, width)
    png = {kind: cv2.imread(str(folder / f"{key}.{kind}.png"), cv2.IMREAD_UNCHANGED)
           for kind in ("leaf", "part", "vein", "water", "depth", "normals")}
    for kind, picture in png.items():
        assert picture.dtype == (np.uint8 if kind in ("leaf", "part", "vein") else np.uint16), (key, kind, picture.dtype)
        assert picture.shape == ((height, width, 3) if kind == "normals" else (height, width)), (key, kind, picture.shape)
    leaf = maps["part"] > 0
    assert (png["leaf"] == np.where(leaf, 255, 0)).all()
    assert (png["part"] == maps["part"]).all() and (png["vein"] == maps["vein"]).all()
    assert np.abs(png["water"] / 65535 - maps["water"]).max() <= 0.51 / 65535
    unit = about["depth_unit"]
    assert (png["depth"][~leaf] == 0).all()
    assert (np.abs(png["depth"][leaf] * unit - maps["depth"][leaf]) <= 0.51 * unit).all()
    xyz = (png["normals"][..., ::-1].astype(float) - 32768) / 32767  # OpenCV gives blue first
    assert np.abs(xyz[leaf] - normals[leaf]).max(initial=0) <= 0.51 / 32767
    assert (png["normals"][~leaf] == 0).all()
    if key == UNSEEN:
        assert not leaf.any() and about["area"] == 0 and about["box"] == [0, 0, 0, 0]
        return
    assert unit in (1e-6, 2e-6, 5e-6, 1e-5, 2e-5, 5e-5) and maps["depth"][leaf].max() / unit <= 65535
    rows, columns = np.nonzero(leaf)
    assert about["box"] == [columns.min(), rows.min(), np.ptp(columns) + 1, np.ptp(rows) + 1]
    assert about["area"] == leaf.sum()
    assert about["pixels"]["blade"] == (maps["part"] == 1).sum() and about["pixels"]["stalk"] == (maps["part"] == 2).sum()
    assert about["pixels"]["veins"] == {"1": (maps["vein"] == 1).sum(), "2": (maps["vein"] == 2).sum()}
    assert abs(about["water"] - maps["water"][maps["part"] == 1].mean()) < 1e-5
    assert len(about["tips"]) == 2 and about["apex"] in about["tips"]


def check_camera(folder, key):
    """The pinhole that the labels state, with the depth of a pixel, gives a point that falls into that pixel again
    and stands before the table (z >= 0)."""
    about = labels(folder, key)
    camera = {name: np.array(value) for name, value in about["camera"].items()}
    maps, _ = numbers(folder, key, about["height"], about["width"])
    rows, columns = np.nonzero(maps["part"])
    depth = maps["depth"][rows, columns][:, None].astype(float)
    pixel = np.stack([columns + 0.5, rows + 0.5], 1)
    x, y = ((pixel - camera["centre"]) / camera["focal"]).T
    points = camera["position"] + depth * (camera["forward"] + x[:, None] * camera["right"] - y[:, None] * camera["up"])
    assert points[:, 2].min() > -1e-6 and np.ptp(points, axis=0).max() < 0.2
    assert np.allclose((points - camera["position"]) @ camera["forward"], depth[:, 0], rtol=1e-6)


def decoded(segmentation):
    """The mask of COCO's run lengths: column by column, background first."""
    height, width = segmentation["size"]
    counts = segmentation["counts"]
    values = np.repeat(np.arange(len(counts)) % 2, counts)
    return values.reshape(width, height).T


def check_coco(folder):
    coco = json.loads((folder / "coco.json").read_text())
    assert [image["file_name"] for image in coco["images"]] == [f"{key}.png" for key in KEYS]
    assert [image["id"] for image in coco["images"]] == list(range(1, 8))
    assert [(c["id"], c["name"]) for c in coco["categories"]] == [(1, "maple"), (2, 'ivy <"é>')]
    by_image = {annotation["image_id"]: annotation for annotation in coco["annotations"]}
    assert [annotation["id"] for annotation in coco["annotations"]] == list(range(1, 7)) and len(by_image) == 6
    for image in coco["images"]:
        key = image["file_name"][:6]
        mask = cv2.imread(str(folder / f"{key}.leaf.png"), cv2.IMREAD_UNCHANGED) > 0
        assert (image["height"], image["width"]) == mask.shape
        if key == UNSEEN:
            assert image["id"] not in by_image
            continue
        annotation = by_image[image["id"]]
        assert (decoded(annotation["segmentation"]) == mask).all()
        assert annotation["area"] == mask.sum() and annotation["iscrowd"] == 0
        left, top, width, height = annotation["bbox"]
        assert mask[top:top + height, left:left + width].sum() == mask.sum()
        assert all(edge.any() for edge in (mask[top], mask[top + height - 1], mask[:, left], mask[:, left + width - 1]))
        assert annotation["category_id"] == (2 if key == "000013" else 1)
        about = labels(folder, key)
        assert annotation["keypoints"] == about["base"] + about["apex"] and annotation["num_keypoints"] == 2
        assert annotation["tips"] == about["tips"]


def check_shards(folder):
    """Every member is a plain file with its bytes, without owner or time; the files of a sample stand together."""
    samples = []
    for number in range(3):
        with tarfile.open(folder / f"shard-{number:06}.tar") as shard:
            for member in shard:
                assert member.isfile() and member.mode == 0o644 and member.mtime == 0
                assert (member.uid, member.gid, member.uname, member.gname) == (0, 0, "", "")
                assert shard.extractfile(member).read() == (folder / member.name).read_bytes(), member.name
                key, suffix = member.name.split(".", 1)
                if not samples or samples[-1][1] != key:
                    samples.append((number, key, []))
                samples[-1][2].append(suffix)
    assert samples == [(i // 3, key, ["png", "leaf.png", "depth.png", "json"]) for i, key in enumerate(KEYS)], samples
    assert not (folder / "shard-000003.tar").exists()


def main():
    folder = pathlib.Path(sys.argv[1])
    for key in KEYS:
        check_maps(folder, key)
        if key != UNSEEN:
            check_camera(folder, key)
    check_coco(folder)
    check_shards(folder)
    print("7 pictures, 42 maps, a COCO file and 3 shards are what went into them")


main()
