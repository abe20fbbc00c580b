# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0

# Makes of the page, its scripts and dygraphs one file, in which @DATA@ is left for what it shows, and a C source with its
# bytes. cmake -D FOLDER=(of this file) -D DYGRAPHS=(its files) -D PAGE=(to write) -D SOURCE=(to write) -P embed.cmake
cmake_minimum_required(VERSION 3.20)
file(READ ${FOLDER}/page.html page)
file(READ ${DYGRAPHS}/dygraph.min.css style)
file(READ ${DYGRAPHS}/dygraph.min.js plots)
file(READ ${FOLDER}/dygraphs-licence.txt licence)
# maps of the sources are files that the page has not
string(REGEX REPLACE "/[/*]# sourceMappingURL=[a-z.]*( \\*/)?" "" style "${style}")
string(REGEX REPLACE "//# sourceMappingURL=[a-z.]*" "" plots "${plots}")
string(REPLACE "<" "&lt;" licence "${licence}")
set(scripts "")
foreach(name motion picture common impact chart results start)
  file(READ ${FOLDER}/${name}.js script)
  string(APPEND scripts "${script}")
endforeach()
string(REPLACE "@DYGRAPHS_STYLE@" "${style}" page "${page}")
string(REPLACE "@DYGRAPHS_LICENCE@" "${licence}" page "${page}")
string(REPLACE "@DYGRAPHS@" "${plots}" page "${page}")
string(REPLACE "@SCRIPTS@" "${scripts}" page "${page}")
file(WRITE ${PAGE} "${page}")

file(READ ${PAGE} bytes HEX)
string(REGEX REPLACE "(................................................................................)" "\\1\n"
       bytes "${bytes}")
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
file(WRITE ${SOURCE} "extern const unsigned char page_template[];\nconst unsigned char page_template[] = {\n${bytes}0};\n")
