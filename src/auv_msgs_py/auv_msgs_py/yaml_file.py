"""YAML in, validated settings out; YAML 1.2 scalars, duplicate keys refused."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any, ClassVar, TypeVar

import yaml

from auv_msgs_py.errors import ConfigurationError
from auv_msgs_py.settings import validated

T = TypeVar("T")


_NOT_AS_IN_1_1 = ("bool", "int", "float", "timestamp")


class _Loader(getattr(yaml, "CSafeLoader", yaml.SafeLoader)):  # type: ignore[misc]
    """PyYAML reads YAML 1.1, where `off` is false, `1e-3` is text and `12:30` is 750. Nobody expects that."""

    yaml_implicit_resolvers: ClassVar[dict[str, Any]] = {
        first: [(tag, pattern) for tag, pattern in pairs if tag.rsplit(":", 1)[-1] not in _NOT_AS_IN_1_1]
        for first, pairs in yaml.SafeLoader.yaml_implicit_resolvers.items()
    }

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Any, Any]:
        seen = set()
        for key_node, _ in node.value:
            if not isinstance(key_node, yaml.ScalarNode):
                raise yaml.constructor.ConstructorError(
                    None, None, "a list or mapping as key", key_node.start_mark
                )
            if key_node.tag == "tag:yaml.org,2002:merge":
                continue
            key = self.construct_object(key_node, deep=True)
            if key in seen:
                raise yaml.constructor.ConstructorError(
                    None, None, f"the key {key!r} stands there twice", key_node.start_mark
                )
            seen.add(key)
        return super().construct_mapping(node, deep)  # type: ignore[no-any-return]


class _Dumper(yaml.SafeDumper):
    """Puts text in quotes that either version of YAML would read as something else."""


#: Whole numbers of YAML 1.2 in decimal; a leading zero means eight to one parser and ten to another: text.
_INT = re.compile(r"^[-+]?(?:0|[1-9][0-9]*)$")
_FLOAT = re.compile(
    r"^[-+]?(?:(?:[0-9]+\.[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?|[0-9]+[eE][-+]?[0-9]+"
    r"|\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN))$"
)
_Loader.add_implicit_resolver(
    "tag:yaml.org,2002:bool", re.compile(r"^(?:true|True|TRUE|false|False|FALSE)$"), "tTfF"
)
_Loader.add_implicit_resolver("tag:yaml.org,2002:int", _INT, "-+0123456789")
for _class in (_Loader, _Dumper):
    _class.add_implicit_resolver("tag:yaml.org,2002:float", _FLOAT, "-+0123456789.")


def parse(path: Path) -> Any:
    """The file as plain Python objects.

    Raises:
        ConfigurationError: the file is missing, not readable, not text or not YAML, with line and column.
    """
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise ConfigurationError(str(path), "no such file", "a YAML file") from None
    except (OSError, UnicodeDecodeError) as error:
        raise ConfigurationError(
            str(path), f"a file that cannot be read ({error})", "a YAML text file"
        ) from None
    try:
        return yaml.load(text, Loader=_Loader)  # noqa: S506 - _Loader derives from the safe loader
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        place = f"{path}: line {mark.line + 1}, column {mark.column + 1}" if mark else str(path)
        problem = getattr(error, "problem", None) or str(error).splitlines()[0]
        raise ConfigurationError(
            place, f"text that cannot be read ({problem})", "YAML, each key once"
        ) from None


def load(path: Path, cls: type[T]) -> T:
    """Read a YAML file into a settings class.

    Raises:
        ConfigurationError: one line with file and key, what was found and what was expected.
    """
    data = parse(path)
    if data is None:
        raise ConfigurationError(str(path), "an empty file", "a mapping of keys to values")
    return validated(cls, data, str(path))


def dump(data: Any, path: Path) -> None:
    """Write plain objects as YAML that both this module and ROS 2's parameter parser read back alike."""
    path.write_text(yaml.dump(data, Dumper=_Dumper, sort_keys=False, allow_unicode=True), encoding="utf-8")
