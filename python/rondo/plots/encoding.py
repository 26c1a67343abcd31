# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a film into a file: mp4 by the program ffmpeg, gif by Pillow."""
from __future__ import annotations

import os
import pathlib
import shutil
import subprocess
import tempfile
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from ..data.errors import Error

Picture = NDArray[np.uint8]  # (height, width, 4): red, green, blue, opacity
FFMPEG = "ffmpeg"
QUALITY = ("-preset", "veryfast", "-crf", "22")  # as large as by default, in half the time
SAMPLES = 8  # pictures from which the colours of a gif are taken


def has_ffmpeg() -> bool:
    return shutil.which(FFMPEG) is not None


def write_film(pictures: Iterable[Picture], samples: Iterable[Picture], path: pathlib.Path,
               fps: int) -> None:
    """Into a file beside `path` that takes its place when it is complete. `samples` are some of the
    pictures, for the colours of a gif."""
    ending = path.suffix.lower()
    part = path.with_name(f".{path.stem}.{os.getpid()}.tmp{ending}")
    try:
        if ending == ".mp4":
            _write_mp4(pictures, part, fps)
        else:
            _write_gif(pictures, samples, part, fps)
        os.replace(part, path)
    except OSError as reason:
        raise Error(f"{path}: the film cannot be written: {reason}") from None
    finally:
        part.unlink(missing_ok=True)


def _write_mp4(pictures: Iterable[Picture], path: pathlib.Path, fps: int) -> None:
    stream = iter(pictures)
    first = next(stream)
    height, width = first.shape[:2]
    command = [FFMPEG, "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgba", "-s",
               f"{width}x{height}", "-r", str(fps), "-i", "-", "-c:v", "h264", *QUALITY,
               "-pix_fmt", "yuv420p", str(path)]
    with tempfile.TemporaryFile() as said:
        process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=said, stderr=said)
        assert process.stdin is not None
        try:
            process.stdin.write(first.data)
            for picture in stream:
                process.stdin.write(picture.data)
            process.stdin.close()
        except BrokenPipeError:  # it has ended, and says why
            pass
        except BaseException:
            process.kill()
            process.wait()
            raise
        if process.wait() != 0:
            said.seek(0)
            reason = said.read().decode(errors="replace").strip()
            raise OSError(f"ffmpeg, exit code {process.returncode}: {reason}")


def _write_gif(pictures: Iterable[Picture], samples: Iterable[Picture], path: pathlib.Path,
               fps: int) -> None:
    """All pictures with one palette, which is faster than one for each, and colours do not jump."""
    palette = Image.fromarray(np.concatenate([sample[..., :3] for sample in samples])).quantize(
        256, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
    few = [Image.fromarray(picture[..., :3]).quantize(palette=palette, dither=Image.Dither.NONE)
           for picture in pictures]
    few[0].save(path, save_all=True, append_images=few[1:], duration=int(1000 / fps), loop=0)
