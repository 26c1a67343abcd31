# SPDX-License-Identifier: BSD-3-Clause
"""Films: pictures, sizes and rates in the files, what the pictures show, and wrong input."""
import subprocess

import matplotlib.colors
import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from PIL import Image

import rondo
from rondo.plots import animation, encoding


def probe(path, entry):
    """What ffprobe says of a film's picture."""
    done = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-select_streams", "v:0",
                           "-show_entries", f"stream={entry}", "-of", "csv=p=0", str(path)],
                          capture_output=True, text=True, check=True)
    return done.stdout.strip()


def film(run, follow=False, quantity="displacement", chosen=(0, 5, 10), width=333):
    with matplotlib.rc_context({"figure.constrained_layout.use": False}):
        return animation._Film(run, np.array(chosen), quantity, (0.0, 1.0), follow, width,
                               (640, 360))


def test_mp4(smooth, tmp_path):
    (tmp_path / "new").mkdir()
    path = rondo.open(smooth).animate(tmp_path / "new" / "film.mp4", frames=5, fps=4, width=401)
    assert path == tmp_path / "new" / "film.mp4"
    assert probe(path, "codec_name") == "h264"
    assert probe(path, "nb_read_frames") == "5"
    assert probe(path, "r_frame_rate") == "4/1"
    width, height = map(int, probe(path, "width,height").split(","))
    assert width in (400, 402) and height % 2 == 0
    assert [p.name for p in path.parent.iterdir()] == ["film.mp4"]  # nothing left beside


def test_gif(crush, tmp_path):
    path = rondo.open(crush).animate(str(tmp_path / "film.GIF"), quantity="von_mises", frames=6,
                                     width=240)
    with Image.open(path) as image:
        assert image.n_frames == 6
        assert image.width == 240
        assert image.info["duration"] == 1000  # 6 pictures, one a second
        first, last = (np.asarray(_frame(image, k)) for k in (0, 5))
    assert np.any(first != last)


def _frame(image, k):
    image.seek(k)
    return image.convert("RGB")


def test_what_a_picture_shows(smooth):
    run = rondo.open(smooth)
    shown = film(run)
    for frame, k in enumerate((0, 5, 10)):
        shown.show(frame)
        corners = np.array([path.vertices[:4] for path in shown.body.cells.get_paths()])
        np.testing.assert_allclose(corners, run.position(k)[run.mesh.cells], rtol=0, atol=1e-14)
        sizes = np.linalg.norm(run.displacement[k], axis=1)[run.mesh.cells].mean(axis=1) * 1e3
        np.testing.assert_allclose(shown.body.cells.get_array(), sizes)
        touching = run.contact.force[k][:, 0] > 0
        line, dots = shown.contact.lines[1], shown.contact.dots[1]
        marked = {tuple(p) for path in line.get_paths() for p in path.vertices}
        marked |= {tuple(p) for p in dots.get_xydata()}
        assert marked == {tuple(p) for p in run.position(k)[run.mesh.boundary[touching]]}
        assert shown.ax.get_title() == f"t = {run.times[k] * 1e3:.1f} ms"
        assert shown.body.rim.mark.get_visible()
        mark = np.array(shown.body.rim.mark.get_data()).T - run.center[k]
        down = [np.sin(run.angle[k]), -np.cos(run.angle[k])]  # R(θ) (0, -1)
        np.testing.assert_allclose(mark[1], run.inner_radius * np.array(down), atol=1e-14)


@pytest.mark.parametrize("follow", [False, True])
def test_the_body_is_in_the_picture_and_round(smooth, follow):
    run = rondo.open(smooth)
    shown = film(run, follow)
    for frame, k in enumerate((0, 5, 10)):
        shown.show(frame)
        shown.ax.figure.canvas.draw()
        points = run.position(k)
        (left, right), (bottom, top) = shown.ax.get_xlim(), shown.ax.get_ylim()
        assert np.all((points > (left, bottom)) & (points < (right, top)))
        box = shown.ax.get_window_extent()
        assert (right - left) / box.width == pytest.approx((top - bottom) / box.height, rel=1e-6)
        if follow:
            assert 0.5 * (left + right) == pytest.approx(run.center[k, 0], abs=0.02)
    size = shown.ax.figure.get_size_inches() * animation.DPI
    np.testing.assert_array_equal(size % 2, 0)


@pytest.mark.parametrize("follow", [False, True])
def test_pictures_are_those_of_the_whole_figure(smooth, follow):
    """Though most of it is drawn once: a picture is in a third of the time so."""
    shown = film(rondo.open(smooth), follow)
    figure, drawn = shown.ax.figure, []
    figure.draw, whole = (lambda renderer: (drawn.append(1), whole(renderer))), figure.draw
    pictures = list(shown.pictures(range(3)))
    assert len(drawn) <= 2
    for artist in figure.findobj(lambda artist: artist.get_animated()):
        artist.set_animated(False)
    for frame, picture in enumerate(pictures):
        shown.show(frame)
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
        assert np.abs(picture.astype(int) - np.asarray(canvas.buffer_rgba())).max() <= 1


def test_ffmpeg_says_why(smooth, tmp_path, monkeypatch):
    monkeypatch.setattr(encoding, "QUALITY", ("-preset", "never"))
    with pytest.raises(rondo.Error, match="a.mp4: the film cannot be written: ffmpeg, exit code"):
        rondo.open(smooth).animate(tmp_path / "a.mp4", frames=2, width=240)
    assert list(tmp_path.iterdir()) == []


def test_it_follows_where_the_way_is_long(smooth, monkeypatch, tmp_path):
    run = rondo.open(smooth)
    followed = []
    monkeypatch.setattr(animation, "_write", lambda shown, *_: followed.append(shown.follow))
    run.animate(tmp_path / "a.gif")
    run.center[:, 0] *= 20
    run.animate(tmp_path / "a.gif")
    run.animate(tmp_path / "a.gif", follow=False)
    assert followed == [False, True, False]


def test_frames_and_colours_by_default(smooth, monkeypatch, tmp_path):
    seen = {}

    def keep(shown, path, fps):
        seen.update(chosen=list(shown.chosen), fps=fps, limits=shown.body.cells.get_clim(),
                    size=shown.ax.figure.get_size_inches() * animation.DPI)

    monkeypatch.setattr(animation, "_write", keep)
    run = rondo.open(smooth)
    run.animate(tmp_path / "a.mp4")
    assert (seen["chosen"], seen["fps"]) == (list(range(11)), 1)
    sizes = np.linalg.norm(run.displacement[:], axis=2) * 1e3
    largest = sizes[:, run.mesh.cells].mean(axis=2).max()  # of the cells as drawn
    np.testing.assert_allclose(seen["limits"], (0, largest))
    assert seen["size"][0] <= 960 and seen["size"][1] <= 542
    run.animate(tmp_path / "a.mp4", quantity="displacement_y", from_time=0.01, frames=3,
                limits=(-1, 2))
    assert run.times[seen["chosen"][0]] >= 0.01 and len(seen["chosen"]) == 3
    assert seen["limits"] == (-1, 2)
    run.times = np.linspace(0, 1, 1000)  # as many as a long run has
    assert len(animation.snapshots_of(run, None, None, None)) == 300
    assert animation.snapshots_of(run, None, None, None)[[0, -1]].tolist() == [0, 999]


def test_wrong_input(smooth, crush, tmp_path, monkeypatch):
    run = rondo.open(smooth)
    for name, options, words in (
            ("a.avi", {}, "ends in .mp4 or .gif, not in '.avi'"),
            ("a", {}, "not in 'nothing'"),
            ("a.gif", {"frames": 12}, "frames = 12: there are 11 snapshots"),
            ("a.gif", {"frames": 0}, "frames = 0: at least 1"),
            ("new/a.gif", {}, "no directory"),
            ("a.gif", {"fps": 0}, "fps = 0"),
            ("a.gif", {"width": 100}, "width = 100: at least"),
            ("a.gif", {"from_time": 3.0}, "no snapshot from 3 s; they are from 0 to 0.02"),
            ("a.gif", {"quantity": "heat"}, "no field 'heat'")):
        with pytest.raises(rondo.Error) as caught:
            run.animate(tmp_path / name, **options)
        assert words in str(caught.value)
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(rondo.Error, match="install the Debian package ffmpeg, or .*ends in .gif"):
        run.animate(tmp_path / "a.mp4")
    assert list(tmp_path.iterdir()) == []


def test_a_place_that_cannot_be_written(smooth, tmp_path):
    (tmp_path / "film.gif").mkdir()
    with pytest.raises(rondo.Error, match="film.gif: the film cannot be written"):
        rondo.open(smooth).animate(tmp_path / "film.gif", frames=2, width=240)
    assert [p.name for p in tmp_path.iterdir()] == ["film.gif"]
