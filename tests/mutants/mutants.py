"""Finds places where a fault can be put into C++ sources, and writes it beside what stands there, to be switched on when
the program runs: fault.hpp. It knows no C++ but what clang-format makes of it: binary operators between spaces, template
brackets without. What it gets wrong does not compile, and is dropped by the one who builds."""
import dataclasses
import pathlib
import re

KEYWORDS = ("using", "namespace", "template", "class", "struct", "enum", "static_assert", "friend", "typedef", "public",
            "private", "protected", "extern", "union", "case", "default", "throw", "delete", "switch", "do", "try", "goto")
SWAPPED = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "&&": "||", "||": "&&", "+": "-", "-": "+",
           "*": "/", "/": "*", "+=": "-=", "-=": "+=", "true": "false", "false": "true", "x": "y", "y": "z", "z": "x"}
PATTERNS = [  # what the fault is called, where: the group is what is replaced
    ("comparison", r" (<=?|>=?|==|!=) "),
    ("logic", r" (&&|\|\|) "),
    ("sign", r"[\w)\]] ([+\-]|\+=|-=) "),
    ("unit", r"[\w)\]] ([*/]) "),
    ("axis", r"\.([xyz])\(\)"),
    ("constant", r"(?<![\w.'])(\d+\.\d*(?:e-?\d+)?|\d+e-?\d+|\d+)(?![\w.'])"),
    ("constant", r"\b(true|false)\b"),
    ("condition", r"\bif \(()"),
    ("dropped call", r"(?<=[;{}\n])\s*\n\s+()(?:[\w:]+(?:\.|->))*[\w:]+\("),
]


@dataclasses.dataclass
class Mutant:
    file: str
    line: int
    kind: str
    before: str
    after: str
    span: tuple  # of the characters that the new text takes the place of
    text: str  # with FAULT for the question whether it is on
    number: int = 0
    later: bool = False  # in a function that may be evaluated while compiling

    @property
    def room(self):
        parts = pathlib.PurePath(self.file).parts
        return "app" if parts[0] == "app" else "/".join(parts[:2])


def blanked(text):
    """The same length, without comments, strings, characters and directives; nor what has no effect: assertions, which a
    release build leaves out, and room that is made ahead."""
    idle = re.compile(r"\bassert\([^;]*(?=;)|[\w.>\-\[\]]+(?:\.|->)reserve\([^;]*(?=;)")
    pattern = r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])*\'|^[ \t]*#(?:\\\n|[^\n])*'
    blank = lambda found: re.sub(r"[^\n]", "~", found[0])
    return idle.sub(blank, re.sub(pattern, blank, text, flags=re.S | re.M))


def closing(code, at):
    """Of the bracket at `at`."""
    depth = 0
    for index in range(at, len(code)):
        depth += (code[index] in "([{") - (code[index] in ")]}")
        if depth == 0:
            return index
    return len(code) - 1


def is_block(code, brace):
    """Whether a brace opens statements, not values."""
    before = code[:brace].rstrip()
    return bool(re.search(r"(\)|\belse|\bdo|\btry|\bconst|\bnoexcept|\boverride|\bfinal|\bmutable|[;{}])$|\) -> [\w:<>*&, ]+$|\][ ]?$"
                          r"|\b(namespace|class|struct|enum)\b[^;{}()]*$", before[-200:]))


def statement(code, at):
    """From where to where the statement around `at` goes, without what it is the branch of."""
    start, depth = at, 0
    while start > 0:
        character = code[start - 1]
        if character in ")]":
            depth += 1
        elif character in "([":
            depth -= 1
        elif character == "{":
            if depth <= 0 and is_block(code, start - 1):
                break
            depth -= 1
        elif character == "}":
            opening, nested = start - 1, 0
            while opening > 0:
                nested += (code[opening] == "}") - (code[opening] == "{")
                if nested == 0:
                    break
                opening -= 1
            if depth <= 0 and is_block(code, opening) and not re.search(r"\][^;{}]*$", code[:opening][-120:]):
                break
            start = opening
            continue
        elif character == ";" and depth <= 0 and not in_for_header(code, start - 1):
            break
        start -= 1
    end, depth = at, 0
    while end < len(code) and not (code[end] == ";" and depth <= 0):
        depth += (code[end] in "([{") - (code[end] in ")]}")
        end += 1
    return start, end + 1


def in_for_header(code, semicolon):
    depth = 0
    for index in range(semicolon - 1, max(0, semicolon - 400), -1):
        depth += (code[index] in ")") - (code[index] in "(")
        if depth < 0:
            return code[:index].endswith("for ")
        if code[index] in "{}":
            return False
    return False


def skip_spaces(code, at):
    while at < len(code) and code[at] in " \n\t~":
        at += 1
    return at


NOWHERE = (0, 0)  # the place lies in a part of a head that cannot be put a question to


def condition_of(code, head, opening, close, at):
    """From where to where the condition of `if (…)`, `while (…)`, `for (…; …; …)` goes, if the place lies in it."""
    if head[1] == "if constexpr":
        return NOWHERE
    parts, depth = [opening], 0
    for index in range(opening, close):
        depth += (code[index] in "([{") - (code[index] in ")]}")
        if code[index] == ";" and depth == 1:
            parts.append(index)
    parts.append(close)
    if head[1] == "for" and len(parts) == 2:
        return NOWHERE
    part = 1 if head[1] == "for" else len(parts) - 2
    begin, end = parts[part] + 1, parts[part + 1]
    return (begin, end) if begin <= at <= end else NOWHERE


def heads(code, start, at):
    """Steps past `if (...)`, `else`, labels and the like that the place does not lie in. Returns where the statement itself
    starts, and the condition that the place lies in, if it does."""
    while True:
        start = skip_spaces(code, start)
        label = re.match(r"(else\b|case [^;{}?]*?:(?!:)|default:|(public|private|protected):)", code[start:at])
        if label:
            start += label.end()
            continue
        head = re.match(r"(if( constexpr)?|while|for) \(", code[start:at + 1])
        if not head:
            return start, None
        opening = start + head.end() - 1
        close = closing(code, opening)
        if at <= close:
            return start, condition_of(code, head, opening, close, at)
        start = close + 1


@dataclasses.dataclass
class Place:
    """Where something is replaced: in `text`, and in `code`, the same without comments."""
    code: str
    text: str
    at: int
    end: int
    after: str

    def changed(self, begin, stop):
        return self.text[begin:self.at] + self.after + self.text[self.end:stop]


def in_condition(place, kind, begin, close):
    if (begin, close) == NOWHERE or re.match(r"\s*(const )?[\w:<>]+[&*]* \w+ = ", place.code[begin:close]):
        return None
    original = place.text[begin:close]
    fault = f"!({original})" if kind == "condition" else place.changed(begin, close)
    return (begin, close), f"(FAULT ? bool({fault}) : bool({original}))"


def in_declaration(place, start, stop, declared):
    words, name = declared[1], declared[2]
    if "constexpr" in words:
        words = words.replace("static constexpr", "static inline const").replace("constexpr", "const")
    if "const " in words:
        name = name.replace("const ", "", 1)
    begin = start + declared.end()
    if place.code[skip_spaces(place.code, begin)] == "{":
        return None
    return (start, stop), f"{words}{name} = FAULT ? ({place.changed(begin, stop - 1)}) : ({place.text[begin:stop - 1]});"


def in_statement(place, kind, start, stop):
    code, at = place.code, place.at
    body, original = code[start:stop], place.text[start:stop]
    if re.match(rf"({'|'.join(KEYWORDS)})\b", body) or start > at:
        return None
    if kind == "dropped call":
        is_call = re.fullmatch(r"(?:[\w:]+(?:\.|->))*[\w:]+\([^;{}]*\);", body)
        return ((start, stop), f"{{ if (!FAULT) {original} }}") if start == at and is_call else None
    declared = re.match(r"((?:static |constexpr |inline |thread_local )*)((?:const )?[\w:<>,* ]+?[&*]* \w+) =\s", body)
    if not body.startswith("return "):
        if declared and start + declared.end() <= at:
            return in_declaration(place, start, stop, declared)
        if re.match(r"[\w:<>,*& ]+ [\w:]+(\(| = )", body) or re.match(r"[\w:<>]+ \w+[,;{(]", body) or \
                re.match(r"[~\w:]+\([^;]*\)\s*:", body):
            return None  # a declaration of another kind
    return (start, stop), f"{{ if (FAULT) {place.changed(start, stop)} else {original} }}"


def written(place, kind):
    """The span and its new text; None where it cannot be written so that it is switched on later."""
    start, stop = statement(place.code, place.at)
    start, condition = heads(place.code, start, place.at)
    if kind == "constant" and not re.match(r"[^;{}]*\bconstexpr\b", place.code[start:place.at]):
        return (place.at, place.end), f"(FAULT ? {place.after} : {place.text[place.at:place.end]})"
    if condition:
        return in_condition(place, kind, *condition)
    return None if kind == "condition" else in_statement(place, kind, start, stop)


def replacement(kind, before):
    if kind in ("condition", "dropped call"):
        return "negated" if kind == "condition" else "nothing"
    if before in SWAPPED:
        return SWAPPED[before]
    if re.fullmatch(r"\d+", before):
        return str(int(before) + 1)
    return f"(1.25 * {before})" if float(before) != 0 else "0.125"


def find(root, files):
    """All that can be put into these files, in the order of where they stand."""
    mutants = []
    for file in files:
        text = (root / file).read_text()
        code = blanked(text)
        for kind, pattern in PATTERNS:
            for found in re.finditer(pattern, code):
                at, end = found.span(1)
                after = replacement(kind, found[1])
                new = written(Place(code, text, at, end, "" if kind in ("condition", "dropped call") else after), kind)
                if new:
                    span, fault = new
                    before = text[span[0]:span[1]] if kind in ("condition", "dropped call") else found[1]
                    mutants.append(Mutant(file, text.count("\n", 0, at) + 1, kind, " ".join(before.split()), after, span, fault))
    return mutants


def write(root, target, mutants):
    """The sources with these in them, in `target`; a file that is as it was is not touched."""
    of_file = {}
    for mutant in mutants:
        of_file.setdefault(mutant.file, []).append(mutant)
    for file in sorted({*of_file, *(str(path.relative_to(target)) for top in ("core", "ui", "app")
                                    for path in (target / top).rglob("*.[ch]pp"))}):
        text = (root / file).read_text()
        for mutant in sorted(of_file.get(file, []), key=lambda mutant: -mutant.span[0]):
            question = f"::nextview_fault::{'is_later' if mutant.later else 'is'}({mutant.number})"
            begin, end = mutant.span
            lines = text.count("\n", begin, end)
            new = " ".join(mutant.text.replace("FAULT", question).split("\n"))
            text = text[:begin] + new + "\n" * lines + text[end:]  # what follows stays in its line
        if (target / file).read_text() != text:
            (target / file).write_text(text)
