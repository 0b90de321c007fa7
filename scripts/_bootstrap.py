"""Makes the environment the suite runs in, then starts the calling script again inside it.

It uses the standard library only, and an older Python can parse it, to get a sentence and not a SyntaxError.
The same holds for every script that calls `ensure_environment`.

The environment lives in `.venv/` of the repository, one per Python version. It is made of the pinned ROS 2
wheels or, when a ROS 2 Jazzy is sourced, of that ROS plus the libraries it lacks (`...-sourced`). The two are
never mixed. A stamp is written last and removed before anything changes, so that an environment without a
stamp is one whose making was interrupted: it is made anew.
"""

from __future__ import annotations

import importlib.machinery
import os
import sys

REPOSITORY = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
ENVIRONMENTS = os.path.join(REPOSITORY, ".venv")
PACKAGES = ("auv_msgs_py", "auv_path_following", "auv_sim")  # in the order of their dependence
OLDEST, NEWEST = (3, 11), (3, 13)
OLDEST_GLIBC = (2, 28)  # of the ROS 2 wheels
DISK_NEEDED = 1_200_000_000  # bytes: the environment, and pip's downloads while it is made
FAILED = 2

_MARKER = "AUV_ENVIRONMENT_ENTERED"
_STAMP = "complete.stamp"


class SetUpError(Exception):
    """There is no environment: one line with the reason and the remedy."""


def ensure_environment(extra=()):
    """Return inside a complete environment; otherwise make it and start the script again inside it.

    Args:
        extra: further requirement files, by name: ("dev",) for requirements/dev.txt.
    """
    try:
        check_python(sys.version_info[:2])
        sourced = is_jazzy_sourced(os.environ)
        environment = environment_path(sourced)
        needed = fingerprint(sourced, extra)
        if not is_complete(environment, needed):
            check_machine(sourced)
            _make_once(environment, sourced, extra, needed)
        entered = os.environ.pop(_MARKER, None)
        if os.path.realpath(sys.prefix) == os.path.realpath(environment):
            sys.excepthook = _unless_interrupted
            return
        if entered:
            raise SetUpError("%s does not start: remove it and start again" % environment)
    except SetUpError as error:
        _say("set-up: %s" % error)
        sys.exit(FAILED)
    except OSError as error:
        _say("set-up: %s: %s" % (error.filename or ENVIRONMENTS, _operating_system_advice(error)))
        sys.exit(FAILED)
    except KeyboardInterrupt:
        _say("\nset-up: interrupted; the next start puts it right")
        sys.exit(130)
    python = _python_of(environment)
    sys.stdout.flush()
    sys.stderr.flush()
    os.execve(python, [python, *sys.orig_argv[1:]], dict(clean(os.environ, sourced), **{_MARKER: "1"}))


def _unless_interrupted(kind, error, trace):
    """Print one line for Ctrl-C while the script still loads; later the command handles it."""
    _say("interrupted") if kind is KeyboardInterrupt else sys.__excepthook__(kind, error, trace)


# --- what this machine is


def check_python(version):
    """Raise SetUpError when the suite does not run on this Python (a pair of numbers)."""
    if OLDEST <= version <= NEWEST:
        return
    import shutil

    names = ["python%d.%d" % (3, minor) for minor in range(NEWEST[1], OLDEST[1] - 1, -1)]
    found = [name for name in names if shutil.which(name)]
    advice = "run this script with %s" % found[0] if found else "install one of them"
    message = "Python 3.%d to 3.%d is needed and this is %d.%d: %s"
    raise SetUpError(message % (OLDEST[1], NEWEST[1], version[0], version[1], advice))


def is_jazzy_sourced(variables):
    """Whether the shell has sourced a ROS 2 Jazzy whose rclpy is to be used.

    Raises:
        SetUpError: it has one, but for another Python.
    """
    if variables.get("ROS_DISTRO") != "jazzy" or not variables.get("AMENT_PREFIX_PATH"):
        return False
    for folder in variables.get("PYTHONPATH", "").split(os.pathsep):
        rclpy = os.path.join(folder, "rclpy")
        if folder and os.path.isdir(rclpy):
            native = [name for name in os.listdir(rclpy) if name.startswith("_rclpy_pybind11.")]
            loadable = {"_rclpy_pybind11" + suffix for suffix in importlib.machinery.EXTENSION_SUFFIXES}
            if loadable & set(native):
                return True
            built = native[0].split(".")[1] if native else "another Python"
            raise SetUpError(
                "the sourced ROS 2 Jazzy is built for %s and this is Python %d.%d: start with that Python, "
                "or in a shell without ROS" % (built, sys.version_info[0], sys.version_info[1])
            )
    return False


def check_machine(sourced):
    """Raise SetUpError when the environment cannot be made on this machine."""
    import importlib.util
    import platform
    import shutil

    if not sourced:
        advice = "install ROS 2 Jazzy, source its setup.bash and start again"
        if sys.platform != "linux" or platform.machine() != "x86_64":
            place = "%s on %s" % (platform.system(), platform.machine())
            raise SetUpError("the ROS 2 wheels are for Linux on x86_64 and this is %s: %s" % (place, advice))
        if not _glibc() >= OLDEST_GLIBC:
            raise SetUpError("the ROS 2 wheels need glibc %d.%d or newer: %s" % (*OLDEST_GLIBC, advice))
    if not importlib.util.find_spec("venv") or not importlib.util.find_spec("ensurepip"):
        ours = "python%d.%d" % sys.version_info[:2]
        standard = os.path.basename(os.path.realpath("/usr/bin/python3")) == ours
        package = "python3-venv" if standard else ours + "-venv"
        raise SetUpError("this Python cannot make virtual environments: sudo apt install %s" % package)
    free = shutil.disk_usage(REPOSITORY).free
    if free < DISK_NEEDED:
        message = "%.1f GB are free under %s and %.1f GB are needed: free some and start again"
        raise SetUpError(message % (free / 1e9, REPOSITORY, DISK_NEEDED / 1e9))


def _glibc():
    try:
        return tuple(int(part) for part in os.confstr("CS_GNU_LIBC_VERSION").split()[1].split("."))
    except (AttributeError, IndexError, OSError, ValueError):
        return (0,)  # musl and other C libraries


# --- what is there already


def environment_path(sourced):
    name = "py%d%d" % sys.version_info[:2]
    return os.path.join(ENVIRONMENTS, name + "-sourced" if sourced else name)


def requirement_files(sourced, extra=()):
    """Return the names under requirements/ in the order in which they are installed."""
    return (["sourced"] if sourced else ["ros", "tools"]) + list(extra)


def fingerprint(sourced, extra):
    """Return the lines of a complete environment's stamp: its place and what it was made from."""
    import hashlib

    def digest(paths):
        together = hashlib.sha256()
        for path in paths:
            with open(os.path.join(REPOSITORY, path), "rb") as file:
                together.update(file.read() + b"\0")
        return together.hexdigest()

    names = [*requirement_files(sourced), "constraints", "tools"]
    base = [os.path.join("requirements", name + ".txt") for name in names]
    for package in PACKAGES:
        base += [os.path.join("src", package, name) for name in ("package.xml", "setup.py", "setup.cfg")]
    version = "%d.%d" % sys.version_info[:2]
    lines = ["at %s" % REPOSITORY, "base %s %s" % (version, digest(base))]
    return lines + ["%s %s" % (name, digest([os.path.join("requirements", name + ".txt")])) for name in extra]


def is_complete(environment, needed):
    return set(needed) <= set(_stamped(environment)) and os.path.exists(_python_of(environment))


def _python_of(environment):
    return os.path.join(environment, "bin", "python")


def _stamped(environment):
    try:
        with open(os.path.join(environment, _STAMP), encoding="utf-8") as file:
            return file.read().splitlines()
    except OSError:
        return []


def clean(variables, sourced):
    """Return the variables to enter the environment with: none of another environment or ROS."""
    kept = dict(variables)
    prefixes = [folder for folder in kept.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if folder]
    # The first is the wheels' own mark that their libraries are found: true only where it was made.
    for name in ("_ROS_WHEELS_BOOTSTRAP_COMPLETE", "VIRTUAL_ENV", "PYTHONHOME"):
        kept.pop(name, None)
    if not sourced:
        for name in (
            "ROS_DISTRO", "AMENT_PREFIX_PATH", "COLCON_PREFIX_PATH", "CMAKE_PREFIX_PATH", "PYTHONPATH",
        ):  # fmt: skip
            kept.pop(name, None)
        if kept.get("RMW_IMPLEMENTATION") != "rmw_fastrtps_cpp":
            kept.pop("RMW_IMPLEMENTATION", None)
    libraries = [folder for folder in kept.pop("LD_LIBRARY_PATH", "").split(os.pathsep) if folder]
    libraries = [folder for folder in libraries if not _is_foreign(folder, () if sourced else prefixes)]
    if libraries:
        kept["LD_LIBRARY_PATH"] = os.pathsep.join(libraries)
    return kept


def _is_foreign(folder, prefixes):
    """Whether a library folder belongs to another environment's wheels or to an unused ROS."""
    in_environment = os.path.exists(os.path.join(os.path.dirname(folder), "pyvenv.cfg"))
    if in_environment or "/site-packages/ros_" in folder:
        return True
    return any(os.path.join(folder, "").startswith(os.path.join(prefix, "")) for prefix in prefixes)


# --- making it


def _make_once(environment, sourced, extra, needed):
    """Make or complete the environment, one process at a time."""
    import fcntl

    os.makedirs(ENVIRONMENTS, exist_ok=True)
    with open(environment + ".lock", "w", encoding="utf-8") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            _say("set-up: another start is making the environment; waiting for it")
            fcntl.flock(lock, fcntl.LOCK_EX)
        if not is_complete(environment, needed):
            _make(environment, sourced, extra, needed, lock)


def _make(environment, sourced, extra, needed, lock):
    from time import monotonic

    began = monotonic()
    stamp = os.path.join(environment, _STAMP)
    before = _stamped(environment)
    usable = bool(before) and before[0] == needed[0] and os.path.exists(_python_of(environment))
    base_is_there = usable and needed[1] in before
    steps = _steps(environment, sourced, extra, usable, base_is_there)
    what = os.path.relpath(environment, REPOSITORY)
    _say("set-up: %s %s (once; it takes a minute or two)" % ("updating" if usable else "making", what))
    if os.path.exists(stamp):
        os.remove(stamp)
    for number, (label, command) in enumerate(steps, 1):
        code, output = _run("[%d/%d] %s" % (number, len(steps), label), command, sourced, lock)
        if code != 0:
            advice, harmless = advice_on(output)
            if usable and harmless:
                _write(stamp, before)  # pip fetches everything before it changes anything
            if not advice:
                for line in output[-12:]:
                    _say("    " + line)
                advice = "its last lines stand above; remove %s and start again" % what
            raise SetUpError("%s: %s" % (label, advice))
    _write(stamp, needed + ([line for line in before if line not in needed] if base_is_there else []))
    _say("set-up: ready after %.0f s" % (monotonic() - began))


def _steps(environment, sourced, extra, usable, base_is_there):
    """The labels and commands that complete an environment, in order."""
    python = _python_of(environment)
    pip = [python, "-m", "pip", "install", "--no-compile"]  # what is used compiles itself at its first import

    steps = []
    if not usable:
        # With the interpreter outside any environment, so that none depends on another.
        command = [getattr(sys, "_base_executable", None) or sys.executable, "-m", "venv", "--clear"]
        command += ["--system-site-packages", environment] if sourced else [environment]
        steps.append(("an empty environment", command))
    if not base_is_there:
        files = [_requirement_file(name) for name in requirement_files(sourced)]
        steps.append(("libraries" if sourced else "ROS 2 Jazzy and libraries", pip + _each("-r", files)))
    for name in extra:
        # Without a wheel, built with the pinned setuptools: nothing unpinned is fetched.
        command = [*pip, "--no-build-isolation", "-r", _requirement_file(name)]
        steps.append(("tools for development" if name == "dev" else name, command))
    if not base_is_there:
        folders = [os.path.join(REPOSITORY, "src", package) for package in PACKAGES]
        command = [*pip, "--no-deps", "--no-build-isolation", "--no-index", "--use-pep517"]
        command += ["--config-settings", "editable_mode=compat"]
        steps.append(("the suite", command + _each("-e", folders)))
        trial = "import rclpy, nav_msgs.msg, numpy, " + ", ".join(PACKAGES)
        steps.append(("a trial", [python, "-c", trial]))
    return steps


def _requirement_file(name):
    return os.path.join(REPOSITORY, "requirements", name + ".txt")


def _each(option, values):
    return [part for value in values for part in (option, value)]


def _write(path, lines):
    with open(path + ".part", "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
        file.flush()
        os.fsync(file.fileno())
    os.replace(path + ".part", path)


def _pip_variables(sourced):
    variables = clean(os.environ, sourced)
    # A person's own pip settings may name a user folder or a target: neither belongs here.
    for name in ("USER", "TARGET", "PREFIX", "QUIET", "CONSTRAINT", "REQUIREMENT"):
        variables.pop("PIP_" + name, None)
    variables.update(PIP_DISABLE_PIP_VERSION_CHECK="1", PIP_NO_INPUT="1", PIP_PROGRESS_BAR="off")
    variables["LC_ALL"] = "C.UTF-8"  # advice_on reads English
    return variables


def _run(label, command, sourced, lock):
    """Run one step with a live line of progress; return its exit code and its lines of output."""
    import subprocess
    import threading
    from time import monotonic

    began = monotonic()
    output = []
    process = subprocess.Popen(
        command, cwd=REPOSITORY, env=_pip_variables(sourced), universal_newlines=True, errors="replace",
        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        pass_fds=(lock.fileno(),),  # should this process die, pip keeps the lock until it is done
    )  # fmt: skip
    reader = threading.Thread(target=lambda: output.extend(line.rstrip() for line in process.stdout))
    reader.start()
    live = sys.stderr.isatty()
    if not live:
        _say(label)
    spoken = 0.0
    try:
        while reader.is_alive():
            reader.join(0.2)
            elapsed = monotonic() - began
            if live:
                sys.stderr.write("\r\033[K%s: %s" % (label, _progress(output, elapsed)))
                sys.stderr.flush()
            elif elapsed - spoken >= 15.0:
                spoken = elapsed
                _say("      %s" % _progress(output, elapsed))
        code = process.wait()
    except BaseException:
        process.terminate()
        process.wait()
        raise
    done = "%s%s" % (_progress(output, monotonic() - began), "" if code == 0 else ", failed")
    _say("\r\033[K%s: %s" % (label, done) if live else "      %s" % done)
    return code, output


def _progress(output, elapsed):
    packages = sum(line.startswith(("Collecting ", "Obtaining ")) for line in list(output))
    return "%s%.0f s" % ("%d packages, " % packages if packages else "", elapsed)


# --- words


def advice_on(output):
    """Return advice on pip's output (empty if it is unusual), and whether nothing has changed."""
    text = "\n".join(output)
    if "No space left on device" in text or "Disk quota exceeded" in text:
        return "the disk is full: free about %.1f GB and start again" % (DISK_NEEDED / 1e9), False
    signs = (
        "Failed to establish a new connection", "Temporary failure in name resolution", "NameResolutionError",
        "Name or service not known", "Network is unreachable", "Connection refused", "Connection reset",
        "Connection aborted", "connection broken", "Read timed out", "ConnectTimeoutError",
        "ReadTimeoutError", "ProxyError", "SSLError", "Could not fetch URL",
    )  # fmt: skip
    if any(sign in text for sign in signs):
        return "the package index cannot be reached: check the network (or proxy) and start again", True
    return "", False


def _operating_system_advice(error):
    import errno

    if error.errno in (errno.ENOSPC, errno.EDQUOT):
        return "the disk is full: free about %.1f GB and start again" % (DISK_NEEDED / 1e9)
    if error.errno in (errno.EACCES, errno.EPERM, errno.EROFS):
        return "it cannot be written: use a clone that belongs to you"
    return error.strerror or str(error)


def _say(line):
    sys.stderr.write(line + "\n")
    sys.stderr.flush()
