# SPDX-License-Identifier: MIT
"""A hook of MkDocs: pages of the site that are not in docs/, and links between all of them.

A link that is right in the repository is right on the site: it leads to the page of a Markdown file,
to the API documentation of a public header, or to a page that shows a source file. A link to a file
that does not exist stays as it is, and MkDocs reports it.
"""

import os
import posixpath
import re
from collections.abc import Callable
from pathlib import Path

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

ROOT = Path(__file__).parents[2]
API = ROOT / "build" / "api" / "html"
OUTSIDE = {"README.md": "index.md"} | {
    name: name
    for name in ["datasets/README.md", "CONTRIBUTING.md", "CHANGELOG.md", "SECURITY.md"]
}
"""Markdown files outside of docs/, and their places on the site."""

LINK = re.compile(r"(?<=\]\()(?!https?:|#)([^)#\s]+)")
FENCE = re.compile(r"^```.*?^```$", re.MULTILINE | re.DOTALL)


def on_files(files: Files, config: MkDocsConfig) -> Files:
    for source, place in OUTSIDE.items():
        files.append(File.generated(config, place, content=(ROOT / source).read_text()))
    for path in sorted(API.iterdir()):
        if path.is_file():
            files.append(File.generated(config, f"api/{path.name}", abs_src_path=str(path)))
    for name in ["iframe-worker.js", "site.css"]:
        path = Path(__file__).with_name(name)
        files.append(File.generated(config, name, abs_src_path=str(path)))
    for file in [file for file in files if file.is_documentation_page()]:
        for path in _linked_sources(file):
            if _source_page(path) not in files.src_uris:
                files.append(_make_source_page(path, config))
    return files


def on_page_markdown(markdown: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    if page.file.src_uri.startswith("source/"):
        return markdown
    here = posixpath.dirname(page.file.src_uri)

    def link(match: re.Match[str]) -> str:
        return posixpath.relpath(_place(_target(page.file, match[1])), here)

    return _outside_of_fences(markdown, lambda text: LINK.sub(link, text))


def _outside_of_fences(markdown: str, change: Callable[[str], str]) -> str:
    fences = FENCE.findall(markdown)
    texts = [change(text) for text in FENCE.split(markdown)]
    return "".join(part for pair in zip(texts, [*fences, ""]) for part in pair)


def _target(file: File, link: str) -> str:
    """Returns the path in the repository that a link of a page leads to."""
    pages = {place: source for source, place in OUTSIDE.items()}
    source = pages.get(file.src_uri, f"docs/{file.src_uri}")
    return posixpath.normpath(posixpath.join(posixpath.dirname(source), link))


def _place(path: str) -> str:
    """Returns the place on the site of a path in the repository."""
    if path in OUTSIDE:
        return OUTSIDE[path]
    if path.startswith("docs/"):
        return path.removeprefix("docs/")
    reference = _api_page(path)
    return reference if reference else _source_page(path)


def _api_page(path: str) -> str | None:
    """Returns the page of a public header. The shortest path that is unique names it."""
    if not path.endswith(".h"):
        return None
    parts = path.split("/")
    for i in reversed(range(len(parts))):
        name = "_2".join(part.replace("_", "__").replace(".", "_8") for part in parts[i:])
        if (API / f"{name}_source.html").exists():
            return f"api/{name}_source.html"
    return None


def _source_page(path: str) -> str:
    return f"source/{path}.md"


def _linked_sources(file: File) -> list[str]:
    """Returns the files and folders of the repository that a page links to and that are no pages."""
    paths = [
        _target(file, link)
        for text in FENCE.split(file.content_string)
        for link in LINK.findall(text)
    ]
    return [path for path in paths if _place(path) == _source_page(path) and (ROOT / path).exists()]


def _make_source_page(path: str, config: MkDocsConfig) -> File:
    header = f"---\ntitle: {path}\nsearch: {{exclude: true}}\n---\n# {path}\n\n"
    if (ROOT / path).is_dir():
        body = "".join(f"- `{name}`\n" for name in sorted(os.listdir(ROOT / path)))
    else:
        body = f"```{Path(path).suffix[1:]}\n{(ROOT / path).read_text()}```\n"
    return File.generated(config, _source_page(path), content=header + body)
