// SPDX-License-Identifier: BSD-3-Clause
#include "sim/report/page.h"

#include "sim/report/packed.h"
#include "sim/report/printable.h"
#include "sim/report/viewer.h"

namespace ncsim::report {
void WriteHtml(const Page& page, std::ostream& out) {
  const std::string_view index = ViewerIndex();
  std::size_t at = 0;
  // index.html says where what goes: <!--ncsim:NAME-->.
  const auto fill = [&](std::string_view name, std::string_view open, std::string_view content,
                        std::string_view close) {
    const std::string mark = "<!--ncsim:" + std::string(name) + "-->";
    const std::size_t found = index.find(mark, at);
    out << index.substr(at, found - at) << open << content << close;
    at = found + mark.size();
  };
  fill("title", "<title>",
       Markup(std::string(ToString(page.result->verdict)) + ": " + page.result->program) +
           " - ncsim",
       "</title>");
  fill("style", "<style>", ViewerStyle(), "</style>");
  fill("three", "<script type=\"application/gzip\" id=\"three\">", Base64(Gzip(ViewerThree())),
       "</script>");
  fill("data", "<script type=\"application/gzip\" id=\"data\">", Base64(Gzip(PageData(page))),
       "</script>");
  fill("script", "<script>\n", ViewerScript(), "</script>");
  out << index.substr(at);
}

}  // namespace ncsim::report
