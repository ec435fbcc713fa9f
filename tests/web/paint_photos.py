"""Photos of a painted leaf: paint_photos.py FOLDER writes lobed.jpg (a palmate leaf with veins whose basal lobes overlap, on
paper lit from one side, beside a ruler and a coin) and stalked.png (with a stalk, its background transparent)."""
import sys

import cv2
import numpy as np


def lobed(size, centre):
    angle = np.linspace(0, 2 * np.pi, 3000, endpoint=False)
    lobes = 0.72 - 0.2 * np.cos(5 * angle) + 0.02 * np.cos(40 * angle)
    radius = size * (lobes - 0.3 * np.exp(-200 * np.minimum(angle, 2 * np.pi - angle) ** 2))
    return centre + radius[:, None] * np.stack([np.sin(angle), np.cos(angle)], axis=1)


def fill(picture, ring, colour):
    cv2.fillPoly(picture, [np.round(16 * ring).astype(np.int32)], colour, cv2.LINE_AA, 4)


def veined(picture, centre, size):
    for vein in range(5):
        angle = 2 * np.pi * (vein + 0.5) / 5
        tip = centre + 0.8 * size * np.array([np.sin(angle), np.cos(angle)])
        cv2.line(picture, np.round(centre).astype(int).tolist(), np.round(tip).astype(int).tolist(), (90, 190, 150), 5, cv2.LINE_AA)


def lit_and_grainy(picture):
    height, width = picture.shape[:2]
    y, x = np.mgrid[0:height, 0:width]
    light = 1 - 0.25 * (x / width + y / height) / 2
    grain = np.random.default_rng(3).normal(0, 2, picture.shape)
    return np.clip(picture * light[..., None] + grain, 0, 255).astype(np.uint8)


def main():
    folder = sys.argv[1]
    paper = np.full((900, 1000, 3), (225, 232, 235), np.uint8)
    centre, size = np.array([520.0, 430.0]), 330.0
    fill(paper, lobed(size, centre), (45, 125, 65))
    veined(paper, centre, size)
    cv2.rectangle(paper, (40, 820), (400, 870), (40, 40, 40), -1)
    cv2.circle(paper, (900, 820), 40, (60, 110, 160), -1, cv2.LINE_AA)
    cv2.imwrite(f"{folder}/lobed.jpg", lit_and_grainy(paper), [cv2.IMWRITE_JPEG_QUALITY, 92])

    alpha = np.zeros((700, 600), np.uint8)
    angle = np.linspace(0, 2 * np.pi, 400, endpoint=False)
    fill(alpha, np.array([300, 300]) + np.stack([150 * np.sin(angle), 240 * np.cos(angle)], axis=1), 255)
    fill(alpha, np.array([[294, 530], [306, 530], [304, 660], [296, 660]], float), 255)
    colours = np.full((700, 600, 3), (50, 140, 70), np.uint8)
    cv2.imwrite(f"{folder}/stalked.png", np.dstack([colours, alpha]))


main()
