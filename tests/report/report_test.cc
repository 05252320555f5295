// SPDX-License-Identifier: BSD-3-Clause
// The HTML report as a person uses it, in headless Chromium, from disk: against the trace and the
// findings' own axes.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <sstream>

#include "sim/app/app.h"
#include "sim/nightly/test_folder.h"
#include "tests/corpus/umc750_job.h"
#include "tests/report/browser.h"
#include "tests/report/shown_run.h"

namespace ncsim::report {
namespace {

using Json = nlohmann::json;

constexpr double kMayCover = 0.25;  // of the view, by the headline
constexpr const char* kReady = "window.ncsim && ncsim.path.ready";

class ReportPage : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (!Browser::Find().empty()) browser_ = std::make_unique<Browser>();
  }
  static void TearDownTestSuite() { browser_.reset(); }
  void SetUp() override {
    if (!browser_) GTEST_SKIP() << "there is no chromium";
    complaints_ = browser_->complaints().size();
  }

  void Open(const ShownRun& run, int width, const std::string& scheme = "light") {
    ASSERT_TRUE(std::filesystem::exists(run.html())) << run.messages();
    browser_->Open(run.html(), width, 800, scheme, kReady);
    EXPECT_LT(Covered(), kMayCover) << width;
  }

  /// Share of the 3-D view that lies below the headline.
  static double Covered() {
    return browser_->Evaluate(
        "(() => { const box = (id) => document.getElementById(id).getBoundingClientRect(), "
        "v = box('canvas'), h = box('headline'), over = (from, to) => Math.max(0, "
        "Math.min(v[to], h[to]) - Math.max(v[from], h[from])); "
        "return over('left', 'right') * over('top', 'bottom') / (v.width * v.height); })()");
  }

  /// Whether all text of the headline that matches is there whole: not hidden, not cut.
  static bool IsWhole(const std::string& selector) {
    return browser_->Evaluate("[...document.querySelectorAll('#headline " + selector +
                              "')].every((e) => e.offsetParent && e.scrollHeight <= "
                              "e.clientHeight && e.scrollWidth <= e.clientWidth)");
  }

  /// Axis letters and values that an expression in the page has.
  static std::map<char, double> AxesOf(const std::string& expression) {
    const Json axes = browser_->Evaluate(expression);
    std::map<char, double> values;
    for (const auto& [letter, value] : axes.items()) values[letter[0]] = value;
    return values;
  }

  /// As the machine in the page stands; mm and degrees.
  static std::map<char, double> Shown() {
    return AxesOf(
        "Object.fromEntries(ncsim.run.axes.map((a) => [a.letter, ncsim.view.pose[a.joint]]))");
  }

  static void ExpectAxes(const std::map<char, double>& expected, double tolerance,
                         const std::string& where) {
    const std::map<char, double> shown = Shown();
    for (const auto& [letter, value] : expected) {
      EXPECT_NEAR(shown.at(letter), value, tolerance) << letter << " " << where;
    }
  }

  /// The gauge line and the table in the scene itself, by docs/notation.md: models stand so that
  /// the gauge line's place in the machine frame is X, Y, Z and the table has turned by
  /// Ry(-B) Rz(-C), so its x axis points to (cos B cos C, -sin C, sin B cos C).
  static void ExpectScene(const std::map<char, double>& axes, double mm, const std::string& where) {
    const Json p = browser_->Evaluate(
        "(() => { const v = ncsim.view, x = new THREE.Vector3(1, 0, 0); const at = (i) => "
        "v.links[i].matrixWorld; return [...new THREE.Vector3().setFromMatrixPosition("
        "at(v.machine.spindle)).toArray(), ...x.transformDirection(at(v.machine.table))"
        ".toArray()]; })()");
    const double b = axes.at('B') * M_PI / 180.0, c = axes.at('C') * M_PI / 180.0;
    EXPECT_NEAR(p[0], axes.at('X'), mm) << where;
    EXPECT_NEAR(p[1], axes.at('Y'), mm) << where;
    EXPECT_NEAR(p[2], axes.at('Z'), mm) << where;
    EXPECT_NEAR(p[3], std::cos(b) * std::cos(c), 1e-3 * mm) << where;
    EXPECT_NEAR(p[4], -std::sin(c), 1e-3 * mm) << where;
    EXPECT_NEAR(p[5], std::sin(b) * std::cos(c), 1e-3 * mm) << where;
  }

  /// Rests until the page has been drawn again.
  static void Draw() {
    browser_->Evaluate(
        "new Promise((r) => requestAnimationFrame(() => requestAnimationFrame(() => r(1))))");
  }

  /// How many different colours a grid of points of the 3-D view has.
  static int Colors() {
    Draw();
    return browser_->Evaluate(
        "(() => { const gl = ncsim.view.renderer.getContext(), {width, height} = gl.canvas, "
        "seen = new Set(), p = new Uint8Array(4); for (let i = 1; i < 40; ++i) for (let k = 1; k "
        "< 40; ++k) { gl.readPixels(width * i / 40, height * k / 40, 1, 1, gl.RGBA, "
        "gl.UNSIGNED_BYTE, p); seen.add(p.join()); } return seen.size; })()");
  }

  /// Drags the time to `time` as the slider does.
  static void Scrub(double time) {
    browser_->Evaluate("(() => { const s = document.getElementById('scrub'); s.value = " +
                       std::to_string(time) + "; s.dispatchEvent(new Event('input')); })()");
  }

  static void ClickOn(const std::string& selector) {
    const Json box = browser_->Evaluate(
        "(() => { const r = document.querySelector(" + Json(selector).dump() +
        ").getBoundingClientRect(); return [r.left + r.width / 2, r.top + r.height / 2]; })()");
    browser_->Click(box[0], box[1]);
  }

  void ExpectNoComplaint() {
    const auto& all = browser_->complaints();
    for (std::size_t i = complaints_; i < all.size(); ++i) ADD_FAILURE() << all[i];
  }

  static std::unique_ptr<Browser> browser_;
  std::size_t complaints_ = 0;
};

std::unique_ptr<Browser> ReportPage::browser_;

/// NCSIM_PICTURES: a folder for what the tests see, for docs/images.
void SavePicture(const std::string& png, const std::string& name) {
  const char* folder = std::getenv("NCSIM_PICTURES");
  if (folder != nullptr) std::ofstream(std::string(folder) + "/" + name, std::ios::binary) << png;
}

TEST_F(ReportPage, OpensOnTheFirstErrorWithBothBodiesLit) {
  const ShownRun run(ScenePath("crash_gallery/collision.nc"));
  for (const int width : {1280, 400}) {
    for (const char* scheme : {"light", "dark"}) {
      Open(run, width, scheme);
      EXPECT_GT(Colors(), 60) << width;
      EXPECT_EQ(browser_->Evaluate("document.getElementById('verdict').textContent"), "fail");
      EXPECT_EQ(browser_->Evaluate("ncsim.view.lit.join()"), "T1.holder,jaw");
      EXPECT_EQ(browser_->Evaluate("ncsim.text.now.line"), 12);
      // The finding's own axes, in README.md: Y-221.000 Z-208.500.
      const std::map<char, double> contact = {
          {'X', -445.0}, {'Y', -221.0}, {'Z', -208.5}, {'B', 0.0}, {'C', 0.0}};
      ExpectAxes(contact, 1e-3, "first error");
      ExpectScene(contact, 1e-3, "first error");
      const Json lit = browser_->Evaluate(
          "ncsim.view.bodies.filter((b) => b.group.visible && b.material.emissiveIntensity > 0)"
          ".map((b) => b.name).sort().join()");
      EXPECT_EQ(lit, "T1.holder,jaw");
      // The contact is in the middle of the view.
      EXPECT_LT(browser_->Evaluate("ncsim.view.markers[0].position.distanceTo(ncsim.view.target)"),
                1e-6);
      EXPECT_EQ(browser_->Evaluate("document.documentElement.scrollWidth > innerWidth"), false);
      SavePicture(browser_->Screenshot(),
                  "report_" + std::string(scheme) + "_" + std::to_string(width) + ".png");
    }
  }
  ExpectNoComplaint();
}

TEST_F(ReportPage, ScenesOfTheGalleryOpenOnTheirRule) {
  int opened = 0;
  for (const char* name :
       {"travel-limit.nc", "rapid-contact.nc", "stock-contact.nc", "gouge.nc", "rotary-wrap.mpf",
        "near-miss.nc", "uncertified.nc", "tool-missing.nc", "unsupported-code.nc"}) {
    const ShownRun run(ScenePath(std::string("crash_gallery/") + name));
    Open(run, opened % 2 == 0 ? 1280 : 400);
    EXPECT_GT(Colors(), 30) << name;
    const std::string rule = std::string(name).substr(0, std::string(name).find('.'));
    EXPECT_EQ(browser_->Evaluate("ncsim.current && ncsim.current.rule"), rule) << name;
    ++opened;
  }
  ExpectNoComplaint();
}

TEST_F(ReportPage, ScrubbingMovesTheMachineAsTheTraceSays) {
  const ShownRun run(ScenePath("five_axis/dome.nc"));
  for (const int width : {1280, 400}) {
    Open(run, width);
    for (std::size_t i = 3; i < run.trace().size(); i += run.trace().size() / 25) {
      const TraceRow& row = run.trace()[i];
      Scrub(row.time);
      // Keyframes keep 0.05 mm; a rapid goes another 0.05 mm in a tick.
      ExpectAxes(row.axes, 0.1, "line " + std::to_string(row.line));
      ExpectScene(row.axes, 0.1, "line " + std::to_string(row.line));
    }
    Scrub(1e9);
    ExpectAxes(run.trace().back().axes, 1e-3, "the end");
  }
  ExpectNoComplaint();
}

// What the certified checker has seen as the least clearance is what the page opens on.
TEST_F(ReportPage, APassOpensWhereBodiesComeNearest) {
  const ShownRun run(ScenePath("three_plus_two/angle_block.nc"));
  Open(run, 1280);
  EXPECT_EQ(browser_->Evaluate("ncsim.view.lit.join()"), "T2.flutes,vise");  // README.md
  const Json nearest = browser_->Evaluate(
      "ncsim.page.result.clearances.find((c) => c.bodies.join() === 'T2.flutes,vise')");
  const double seen = nearest["seen_mm"];
  const double shown =
      browser_->Evaluate("ncsim.seen.values[lastAtMost(ncsim.seen.times, ncsim.time + 1e-6)]");
  EXPECT_NEAR(shown, seen, 0.03 * seen);
  ExpectNoComplaint();
}

TEST_F(ReportPage, PickingAFindingALineAndAKey) {
  const ShownRun run(ScenePath("crash_gallery/near-miss.nc"));
  Open(run, 1280);
  Scrub(0.0);
  EXPECT_EQ(browser_->Evaluate("ncsim.view.lit.length"), 0);
  ClickOn("#findings .item");
  EXPECT_EQ(browser_->Evaluate("ncsim.current.rule"), "near-miss");
  const std::map<char, double> own = AxesOf("ncsim.page.result.findings[0].axes");
  ASSERT_EQ(own.size(), 5U);
  ExpectAxes(own, 1e-3, "finding");
  ExpectScene(own, 1e-3, "finding");
  // A line: the machine stands where the motion before it ended.
  const TraceRow& before = run.trace()[run.trace().size() / 2];
  const TraceRow& after = run.trace()[run.trace().size() / 2 + 1];
  browser_->Evaluate("ncsim.goToLine(0, " + std::to_string(after.line) + ")");
  ExpectAxes(before.axes, 0.1, "line");
  browser_->Press("End");
  ExpectAxes(run.trace().back().axes, 1e-3, "End");
  browser_->Press("n");
  EXPECT_EQ(browser_->Evaluate("ncsim.current.rule"), "near-miss");
  browser_->Press("s");
  EXPECT_EQ(browser_->Evaluate("ncsim.view.renderer.clippingPlanes.length"), 1);
  browser_->Press("s");
  const double azimuth = browser_->Evaluate("ncsim.view.turn.azimuth");
  browser_->Drag(300.0, 350.0, 80.0, 0.0);
  EXPECT_GT(browser_->Evaluate("ncsim.view.turn.azimuth"), azimuth + 0.3);
  // A click in the time line goes there: its middle is the middle of the program.
  ClickOn("#plot");
  EXPECT_NEAR(browser_->Evaluate("ncsim.time / ncsim.run.end"), 0.5, 0.01);
  browser_->Press("t");
  EXPECT_EQ(browser_->Evaluate("document.documentElement.classList.contains('dark')"), true);
  const double begin = browser_->Evaluate("ncsim.goTo(0), ncsim.time");
  browser_->Press(" ");
  for (int i = 0; i < 5; ++i) Draw();
  browser_->Press(" ");
  EXPECT_GT(browser_->Evaluate("ncsim.time"), begin);
  EXPECT_EQ(browser_->Evaluate("ncsim.playing"), false);
  ExpectNoComplaint();
}

// What is hidden behind another tab does not scroll by itself.
TEST_F(ReportPage, ATabComesUpWithWhatIsAtWork) {
  const ShownRun run(ScenePath("five_axis/dome.nc"));
  Open(run, 400);
  ClickOn("#tabs [data-tab=text]");
  Draw();
  EXPECT_GT(browser_->Evaluate("ncsim.text.now.line"), 100);
  EXPECT_EQ(browser_->Evaluate(
                "(() => { const row = document.querySelector('#nc .now').getBoundingClientRect(),"
                " box = document.getElementById('nc').getBoundingClientRect();"
                " return row.top >= box.top && row.bottom <= box.bottom; })()"),
            true);
  ExpectNoComplaint();
}

TEST_F(ReportPage, ALongHeadlineLeavesANarrowViewFree) {
  const ShownRun run(ScenePath("crash_gallery/uncertified.mpf"));
  for (const char* scheme : {"light", "dark"}) {
    Open(run, 1280, scheme);
    EXPECT_TRUE(IsWhole("b")) << "there is room";
    Open(run, 400, scheme);
    EXPECT_FALSE(IsWhole("b")) << "the test must be able to fail";
    EXPECT_EQ(browser_->Evaluate("document.querySelector('#headline .lit').innerText"),
              "T1.holder\njaw");
    ClickOn("#headline");
    EXPECT_TRUE(IsWhole("b"));
    EXPECT_TRUE(IsWhole(".where"));
    ClickOn("#headline");
    EXPECT_FALSE(IsWhole("b"));
    // Of any length: it stays within the view, and its end may be scrolled to.
    browser_->Evaluate("ncsim.current.message = 'more '.repeat(500), ncsim.headline()");
    EXPECT_LT(Covered(), kMayCover);
    ClickOn("#headline .more");
    EXPECT_TRUE(IsWhole("b"));
    EXPECT_EQ(browser_->Evaluate(
                  "(() => { const box = document.getElementById('headline'), rect = (e) => "
                  "e.getBoundingClientRect(); box.scrollTop = 1e6; return rect(box).bottom < "
                  "rect(document.getElementById('canvas')).bottom && "
                  "rect(box.querySelector('.lit')).bottom < rect(box).bottom; })()"),
              true);
  }
  ExpectNoComplaint();
}

// A line that cannot be read, a body that cannot be checked, an offset that nobody states.
TEST_F(ReportPage, WhatIsNoMotionIsShownToo) {
  const ShownRun syntax(ScenePath("crash_gallery/syntax.nc"));
  Open(syntax, 1280);
  ExpectAxes(syntax.trace().back().axes, 1e-3, "where the last motion has ended");
  EXPECT_EQ(browser_->Evaluate("ncsim.faulty().some((one) => one)"), false);
  const ShownRun uncertified(ScenePath("crash_gallery/uncertified.nc"));
  Open(uncertified, 1280);
  EXPECT_EQ(browser_->Evaluate("ncsim.view.lit.join()"), "stop");
  Draw();
  const double off = browser_->Evaluate(
      "ncsim.view.box((b) => b.name === 'stop').getCenter(new THREE.Vector3())"
      ".project(ncsim.view.camera).setZ(0).length()");
  EXPECT_LT(off, 0.1) << "it is not in the middle of the view";
  const ShownRun assumed(ScenePath("crash_gallery/assumed.nc"));
  Open(assumed, 1280);
  const double distance = browser_->Evaluate("ncsim.view.turn.distance");
  EXPECT_NEAR(browser_->Evaluate("ncsim.view.fit(), ncsim.view.turn.distance"), distance, 1e-6)
      << "it has no place: all of the machine is shown";
  ExpectNoComplaint();
}

// What `ncsim post --map` has left beside the program.
TEST_F(ReportPage, AFindingShowsTheRecordItWasPostedFrom) {
  const nightly::TestFolder folder("posted_page");
  const std::string job = ScenePath("posted/hub.nc.job.toml").string();
  std::ostringstream out, err;
  ASSERT_EQ(app::Run({"post", ScenePath("posted/hub.cls").string(), "--job", job, "-o",
                      folder / "hub.nc", "--map", "--no-check"},
                     out, err),
            0)
      << err.str();
  const ShownRun run(folder / "hub.nc", {"--job", job, "--clearance", "35"});
  Open(run, 1280);
  ClickOn("#findings .item");
  const Json from = browser_->Evaluate("ncsim.current.posted_from");
  ASSERT_FALSE(from.is_null());
  std::istringstream cl(ReadBytes(ScenePath("posted/hub.cls")));
  std::string record;
  for (int i = 0; i < from.at("line"); ++i) std::getline(cl, record);
  EXPECT_EQ(browser_->Evaluate("document.querySelectorAll('#headline .where')[1].textContent"),
            "from hub.cls line " + std::to_string(from.at("line").get<int>()) + " " + record);
  Open(run, 400);
  EXPECT_FALSE(IsWhole(".where"));
  ClickOn("#headline");
  EXPECT_TRUE(IsWhole(".where"));
  ExpectNoComplaint();
}

class ReportOfTheUmc750Program : public ReportPage, public corpus::Umc750Job {
 protected:
  void TearDown() override { Remove(); }
};

TEST_F(ReportOfTheUmc750Program, ShowsAPassAndACrash) {
  if (!Prepare("ncsim_report_")) GTEST_SKIP() << "NCSIM_CORPUS is not set";
  WriteJob();
  const std::vector<std::string> options = {"--model", Model().string()};
  {
    const ShownRun run(Program(), options);
    for (const int width : {1280, 400}) {
      Open(run, width);
      EXPECT_GT(Colors(), 60);
      EXPECT_EQ(browser_->Evaluate("document.getElementById('verdict').textContent"), "pass");
      EXPECT_EQ(browser_->Evaluate("ncsim.text.texts[0].lines.length >= 16115"), true);
      for (std::size_t i = 100; i < run.trace().size(); i += 1500) {
        Scrub(run.trace()[i].time);
        ExpectAxes(run.trace()[i].axes, 0.1, "line " + std::to_string(run.trace()[i].line));
      }
      SavePicture(browser_->Screenshot(), "report_umc750_" + std::to_string(width) + ".png");
    }
  }
  scene_.riser_diameter = 260.0;  // As Umc750Verdict.WideRiserIsHit has it.
  Keep(2800);
  WriteJob();
  const ShownRun crash(Program(), options);
  ASSERT_EQ(crash.exit_code(), 1) << crash.messages();
  Open(crash, 1280);
  EXPECT_EQ(browser_->Evaluate("document.getElementById('verdict').textContent"), "fail");
  EXPECT_EQ(browser_->Evaluate("ncsim.view.lit.join()"), "T3.holder,riser");
  EXPECT_EQ(browser_->Evaluate("ncsim.text.now.line"), 2789);
  const std::map<char, double> own = AxesOf("ncsim.current.axes");
  ASSERT_EQ(own.size(), 5U);
  ExpectScene(own, 1e-3, "crash");
  SavePicture(browser_->Screenshot(), "report_umc750_crash.png");
  ExpectNoComplaint();
}

}  // namespace
}  // namespace ncsim::report
