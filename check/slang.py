"""Compiles every shader of a folder by Slang, whose library the package slangpy carries: NAME.hlsl becomes NAME.spv.

usage: python3 slang.py LIBRARY FOLDER
LIBRARY is the folder that slangpy was installed to. The first shader is one with an error: a compiler that does not see it proves nothing.
"""

import ctypes
import sys
from pathlib import Path


class Compiler:
    """Slang's command line, in this process: its library takes half a second to load."""

    def __init__(self, folder):
        self.library = ctypes.CDLL(str(next(Path(folder, "slangpy").glob("libslang-compiler.so*"))))
        pointer, text = ctypes.c_void_p, ctypes.c_char_p
        self.session = self.function("spCreateSession", pointer, text)(None)
        self.create = self.function("spCreateCompileRequest", pointer, pointer)
        # The only one without a name of C.
        mode = "_Z28spSetCommandLineCompilerModePN5slang15ICompileRequestE"
        self.set_mode = self.function(mode, None, pointer)
        self.arguments = self.function(
            "spProcessCommandLineArguments", ctypes.c_int, pointer, ctypes.POINTER(text), ctypes.c_int
        )
        self.run = self.function("spCompile", ctypes.c_int, pointer)
        self.output = self.function("spGetDiagnosticOutput", text, pointer)

    def function(self, name, gives, *takes):
        function = self.library[name]
        function.restype, function.argtypes = gives, takes
        return function

    def compile(self, shader):
        """What is wrong with a shader; nothing where it was compiled."""
        request = self.create(self.session)
        self.set_mode(request)
        arguments = [shader, "-entry", "main", "-stage", "compute", "-target", "spirv"]
        arguments += ["-o", shader.with_suffix(".spv")]
        arguments = [str(argument).encode() for argument in arguments]
        list_of = ctypes.c_char_p * len(arguments)
        failed = self.arguments(request, list_of(*arguments), len(arguments)) or self.run(request)
        return (self.output(request) or b"no output").decode() if failed else ""


def main():
    library, folder = sys.argv[1:]
    compiler = Compiler(library)
    planted = Path(folder, "planted.hlsl")
    planted.write_text("[numthreads(1, 1, 1)] void main() { undefined_function(); }\n")
    wrong = compiler.compile(planted)
    planted.unlink()
    if "undefined_function" not in wrong:
        sys.exit(f"Slang does not see the planted error: {wrong}")
    print("planted call of an undefined function: refused, as it should be")
    shaders = sorted(Path(folder).glob("*.hlsl"))
    refused = 0
    for shader in shaders:
        wrong = compiler.compile(shader)
        if wrong:
            refused += 1
            print(f"{shader}: {wrong}", file=sys.stderr)
    print(f"Slang: {len(shaders)} files, {refused} refused")
    if refused or not shaders:
        sys.exit(1)


main()
