# SPDX-License-Identifier: MIT
# Prints the blocks of C++ in Markdown, each as the body of a function with the variables that the
# text takes as given. Blocks with an #include are whole programs, which CMake compiles as examples.
function print_block() {
  if (block ~ /#include/) return
  printf "void Block%d([[maybe_unused]] Given& given) {\n", ++count
  printf "[[maybe_unused]] auto& [odometry, descriptors, more, query] = given;\n%s}\n", block
}
BEGIN { print "#include \"tests/documentation/given.h\"\nnamespace corvo::test {" }
/^```cpp$/ { inside = 1; block = "#line " FNR + 1 " \"" FILENAME "\"\n"; next }
/^```$/ && inside { print_block(); inside = 0 }
inside { block = block $0 "\n" }
END { print "}  // namespace corvo::test"; exit count == 0 }
