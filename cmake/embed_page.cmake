# In: page, a text file in ASCII. Out: out, C++ that returns it. Literals are shorter than the 65536 characters that
# every compiler takes.
file(READ "${page}" text)
string(LENGTH "${text}" length)
set(pieces "")
set(at 0)
while(at LESS length)
  string(SUBSTRING "${text}" ${at} 16000 piece)
  string(APPEND pieces "    page += R\"sahl~(${piece})sahl~\";\n")
  math(EXPR at "${at} + 16000")
endwhile()
file(WRITE "${out}" "#include \"report/web_page.h\"

std::string sahl::report::web_page() {
    std::string page;
    page.reserve(${length});
${pieces}    return page;
}
")
