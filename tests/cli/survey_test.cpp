// --control, --gnss, --fix: the town in the frame of surveyors.

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <utility>

#include "cli_test.hpp"
#include "result_files.hpp"
#include "rewritten_town.hpp"
#include "tcm_icp/core/random.hpp"

namespace tcm_icp::test {
namespace {

const Words kTown = town_scans();

Eigen::Vector3d noise(Rng& rng, double sigma) {
  return sigma * Eigen::Vector3d(standard_normal(rng), standard_normal(rng), standard_normal(rng));
}

std::string numbers(const Eigen::Vector3d& v) {
  std::ostringstream text;
  text << std::setprecision(17) << v.x() << ',' << v.y() << ',' << v.z();
  return text.str();
}

// The town somewhere in UTM zone 32.
class RegisterSurvey : public CliTest {
 protected:
  RegisterSurvey() : truth_(read_truth(town_file("truth.json"))) {
    T_survey_world_.linear() = Eigen::AngleAxisd(2.2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    T_survey_world_.translation() = Eigen::Vector3d(512345.678, 5412345.678, 287.5);
  }

  Eigen::Isometry3d pose(std::size_t i) const { return T_survey_world_ * truth_.scans[i].T_world_scan; }

  // The town's middle, and how far the frame is off there: the mean over the scans of where their origins are.
  double frame_error_m(const PoseFile& file) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < 6; ++i) sum += file.scans[i].T_reference_scan.translation() - pose(i).translation();
    return sum.norm() / 6;
  }
  static const nlohmann::json& point(const nlohmann::json& report, const std::string& name) {
    for (const auto& p : report["survey"]["points"]) {
      if (p["name"] == name) return p;
    }
    throw std::runtime_error("no point " + name);
  }

  Truth truth_;
  Eigen::Isometry3d T_survey_world_ = Eigen::Isometry3d::Identity();
};

TEST_F(RegisterSurvey, TargetsGiveTheFrameAndTheirBlundersAreNamed) {
  Rng rng = make_stream(1, "targets");
  std::string csv = "name,scan,x,y,z,X,Y,Z,sigma,sigma_scan,use\n";
  constexpr double kGiven_m = 0.001, kMeasured_m = 0.003;
  for (std::size_t k = 0; k < 11; ++k) {
    const bool is_check = k >= 8;
    const std::size_t first = k % 6;
    const Eigen::Vector3d place = pose(first) * (Eigen::Vector3d(0, 0, 1) + noise(rng, 8));
    Eigen::Vector3d given = place + noise(rng, kGiven_m);
    if (k == 2) given += Eigen::Vector3d(0.03, -0.04, 0);
    if (k == 5) given += Eigen::Vector3d(0, 0, 0.05);
    for (const std::size_t i : {first, (first + 1) % 6, (first + 2) % 6}) {
      csv += std::string(is_check ? "C" : "T") + std::to_string(k) + "," + town_name(i) + "," +
             numbers(pose(i).inverse() * place + noise(rng, kMeasured_m)) + "," + numbers(given) + ",0.001,0.003," +
             (is_check ? "check" : "control") + "\n";
    }
  }
  folder_.write("control.csv", csv);
  const RunResult result = run(Words{"register"} + kTown +
                               Words{"--out", "out", "--control", "control.csv", "--crs", "EPSG:32632"} + kSmall);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* const said : {"control point T2 in", "control point T5 in", "blunder", "check", "dX"}) {
    EXPECT_NE(result.err.find(said), std::string::npos) << result.err;
  }
  const auto report = read_json(folder() / "out/report.json");
  int num_checks = 0;
  for (const auto& p : report["survey"]["points"]) {
    const std::string name = p["name"];
    const bool is_wrong = name == "T2" || name == "T5";
    EXPECT_EQ(p["status"], name[0] == 'C' ? "check" : is_wrong ? "blunder" : "used") << p;
    if (name[0] != 'C') continue;
    ++num_checks;
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_LT(std::abs(p["residual_m"][axis].get<double>()), 3 * p["sigma_m"][axis].get<double>()) << p;
      EXPECT_LT(p["sigma_m"][axis].get<double>(), 0.015) << p;
    }
  }
  EXPECT_EQ(num_checks, 9);
  EXPECT_EQ(report["survey"]["rotations_determined"], 3);
  const PoseFile poses = read_pose_file(folder() / "out/poses.json");
  EXPECT_EQ(poses.frame, "control points");
  EXPECT_EQ(poses.crs, "EPSG:32632");
  EXPECT_LT(frame_error_m(poses), 0.002);
  EXPECT_TRUE(score_town(poses).recall() == 1.0) << "relative poses, too";
  const std::string html = read_text(folder() / "out/report.html");
  EXPECT_NE(html.find("Survey frame"), std::string::npos);
  EXPECT_NE(html.find("EPSG:32632"), std::string::npos);
}

TEST_F(RegisterSurvey, PositionsWithHalfAMetreAreCoveredByWhatIsStated) {
  Rng rng = make_stream(2, "gnss");
  std::string csv = "scan,X,Y,Z,sigma\n";
  for (std::size_t i = 0; i < 6; ++i) {
    Eigen::Vector3d given = pose(i).translation() + noise(rng, 0.5);
    if (i == 3) given += Eigen::Vector3d(20, 0, 0);  // under a tree
    csv += town_name(i) + "," + numbers(given) + ",0.5\n";
  }
  folder_.write("gnss.csv", csv);
  const RunResult result =
      run(Words{"register"} + kTown +
          Words{"--out", "out", "--gnss", "gnss.csv", "--crs", "EPSG:25832", "--format", "las"} + kSmall);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(ScanReader(folder() / "out/registered.las").coordinate_system().starts_with("PROJCS[\"ETRS89 / UTM"));
  EXPECT_NE(result.err.find("the position of 003.ply contradicts the others"), std::string::npos) << result.err;
  const auto report = read_json(folder() / "out/report.json");
  const PoseFile poses = read_pose_file(folder() / "out/poses.json");
  EXPECT_EQ(poses.frame, "positions of scanners");
  for (std::size_t i = 0; i < 6; ++i) {
    const auto& stated = report["scans"][i]["uncertainty"];
    ASSERT_FALSE(stated.is_null());
    const Eigen::Isometry3d off = pose(i) * poses.scans[i].T_reference_scan.inverse();
    Eigen::Vector3d centre;
    for (int axis = 0; axis < 3; ++axis) centre[axis] = stated["centre_m"][axis];
    const Eigen::Vector3d shift = off * centre - centre;
    const Eigen::AngleAxisd turn(off.linear());
    for (int axis = 0; axis < 3; ++axis) {
      const double sigma_m = stated["sigma_position_m"][axis], sigma_deg = stated["sigma_rotation_deg"][axis];
      EXPECT_LT(std::abs(shift[axis]), 3 * sigma_m);
      EXPECT_LT(std::abs((turn.angle() * turn.axis())[axis] * 180 / M_PI), 3 * sigma_deg);
      EXPECT_GT(sigma_m, 0.15);  // 0.5 m by five positions
      EXPECT_LT(sigma_m, 0.8);
    }
  }
}

TEST_F(RegisterSurvey, FixedScansStayToTheBit) {
  std::string init = "{\"scans\": [";
  for (const std::size_t i : {1U, 4U}) {
    const Eigen::Isometry3d T = pose(i);
    std::ostringstream text;
    text << std::setprecision(17) << (i == 1 ? "" : ",") << "{\"file\": \"" << town_name(i) << "\", \"pose\": [";
    for (int r = 0; r < 4; ++r) {
      for (int c = 0; c < 4; ++c) text << (c == 0 ? (r == 0 ? "[" : ",[") : ",") << T.matrix()(r, c);
      text << "]";
    }
    init += text.str() + "]}";
  }
  folder_.write("init.json", init + "]}");
  const Words start = Words{"register"} + kTown + Words{"--out", "out", "--init", "init.json"} + kSmall;
  const RunResult result = run(start + Words{"--fix", "001.ply", "--fix", "4"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const PoseFile poses = read_pose_file(folder() / "out/poses.json");
  EXPECT_EQ(poses.frame, "fixed scans");
  for (const std::size_t i : {1U, 4U}) EXPECT_EQ(poses.scans[i].T_reference_scan.matrix(), pose(i).matrix());
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_LT(difference_m(poses.scans[i].T_reference_scan, pose(i), 10), 0.05) << i;
  }
  std::filesystem::remove_all(folder() / "out");
  expect_refusal(start + Words{"--fix", "000.ply"}, 1, {"--fix 000.ply", "no initial pose", "--init"});
}

TEST_F(RegisterSurvey, InitialPosesWithStandardDeviationsAreWeighedAndTheWrongOneIsLeftOut) {
  std::string init = "{\"scans\": [";
  for (std::size_t i = 0; i < 6; ++i) {
    Eigen::Isometry3d T = pose(i);
    if (i == 2) T.pretranslate(Eigen::Vector3d(0.4, 0, 0));
    std::ostringstream text;
    text << std::setprecision(17) << (i == 0 ? "" : ",") << "{\"file\": \"" << town_name(i)
         << "\", \"sigma_position_m\": 0.05, \"sigma_rotation_deg\": 0.3, \"pose\": [";
    for (int r = 0; r < 4; ++r) {
      for (int c = 0; c < 4; ++c) text << (c == 0 ? (r == 0 ? "[" : ",[") : ",") << T.matrix()(r, c);
      text << "]";
    }
    init += text.str() + "]}";
  }
  folder_.write("init.json", init + "]}");
  const RunResult result = run(Words{"register"} + kTown + Words{"--out", "out", "--init", "init.json"} + kSmall);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("initial pose of 002.ply contradicts links and other observations and was left out"),
            std::string::npos)
      << result.err;
  const PoseFile poses = read_pose_file(folder() / "out/poses.json");
  EXPECT_EQ(poses.frame, "initial poses");
  EXPECT_LT(frame_error_m(poses), 0.02);  // 0.4 m in one of six would be 0.07
  EXPECT_EQ(score_town(poses).recall(), 1.0);
}

// Points on no surface: nothing fits them.
std::string dust(double phase) {
  std::string text;
  for (int i = 0; i < 3000; ++i) {
    text += std::to_string(std::sin(i + phase) * 5) + " " + std::to_string(std::cos(7.0 * i) * 5) + " " +
            std::to_string(std::sin(3.0 * i * i + phase)) + "\n";
  }
  return text;
}

TEST_F(RegisterSurvey, AScanThatNoLinkHoldsFollowsItsOwnTargets) {
  Rng rng = make_stream(3, "alone");
  folder_.write("alone.xyz", dust(0));
  folder_.write("lost.xyz", dust(1));
  const Eigen::Isometry3d T_alone =
      T_survey_world_ * Eigen::Translation3d(30, 0, 0) * Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized());
  std::string csv = "name,scan,x,y,z,X,Y,Z,sigma\n";
  for (int k = 0; k < 5; ++k) {
    const std::string name = std::string("T") + std::to_string(k);
    for (const auto& [scan, T] :
         {std::pair{std::string("001.ply"), pose(1)}, std::pair{std::string("alone.xyz"), T_alone}}) {
      const Eigen::Vector3d place = T * noise(rng, 6);
      csv += scan[0] + name + "," + scan + "," + numbers(T.inverse() * place + noise(rng, 0.002)) + "," +
             numbers(place + noise(rng, 0.002)) + ",0.003\n";
    }
  }
  csv += "L,lost.xyz,1,2,3,512345,5412345,287,0.003\n";
  folder_.write("control.csv", csv);
  const RunResult result = run(Words{"register"} + town_scans({0, 1, 2}) +
                               Words{"alone.xyz", "lost.xyz", "--out", "out", "--control", "control.csv"} + kSmall);
  ASSERT_EQ(result.exit_code, 3) << result.err;
  EXPECT_NE(result.err.find("control point L in lost.xyz was not used"), std::string::npos) << result.err;
  const PoseFile poses = read_pose_file(folder() / "out/poses.json");
  EXPECT_EQ(poses.scans[3].status, ScanStatus::kRegistered);
  EXPECT_EQ(poses.scans[3].verdict, Verdict::kAccepted);
  EXPECT_NE(poses.scans[3].reason.find("control points of its own alone"), std::string::npos);
  EXPECT_LT(difference_m(poses.scans[3].T_reference_scan, T_alone, 5), 0.02);
  EXPECT_EQ(poses.scans[4].status, ScanStatus::kUnregistered);
  EXPECT_LT(difference_m(poses.scans[0].T_reference_scan, pose(0), 5), 0.03);
}

// Rings, lamps and niches of a tunnel repeat: without positions scans lie on one another, a whole period off.
class RegisterTunnel : public CliTest {
 protected:
  // Scans that were registered more than a metre from where they belong, and those that were registered at all.
  std::pair<int, int> wrong_and_registered(const Words& options) {
    Words command{"register"};
    for (const auto& scan : truth_.scans) command.push_back("tunnel/" + scan.file);
    const RunResult result = run(command + Words{"--out", "out", "--force"} + options);
    EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 3) << result.err;
    const PoseFile poses = read_pose_file(folder() / "out/poses.json");
    const auto is_reference = [](const auto& scan) { return scan.status == ScanStatus::kReference; };
    const auto reference = std::find_if(poses.scans.begin(), poses.scans.end(), is_reference) - poses.scans.begin();
    const auto at = [](const auto& all, auto i) { return all[static_cast<std::size_t>(i)]; };
    std::pair<int, int> out{0, 0};
    for (std::size_t i = 0; i < poses.scans.size(); ++i) {
      if (poses.scans[i].status == ScanStatus::kUnregistered) continue;
      ++out.second;
      const Eigen::Isometry3d truth = at(truth_.scans, reference).T_world_scan.inverse() * truth_.scans[i].T_world_scan;
      const Eigen::Isometry3d found =
          at(poses.scans, reference).T_reference_scan.inverse() * poses.scans[i].T_reference_scan;
      if (difference_m(found, truth, 0) > 1) ++out.first;
    }
    return out;
  }

  Truth truth_;
};

TEST_F(RegisterTunnel, PositionsKeepScansFromLyingAPeriodOff) {
  ASSERT_EQ(run({"simulate", "--scene", "tunnel", "--scans", "5", "--seed", "1", "--step", "0.3", "--out", "tunnel"})
                .exit_code,
            0);
  truth_ = read_truth(folder() / "tunnel/truth.json");
  const auto [wrong, registered] = wrong_and_registered({});
  ASSERT_GT(wrong, 0) << "of " << registered;
  const nlohmann::json written = read_json(folder() / "tunnel/truth.json");
  std::string csv = "scan,x,y,z,X,Y,Z,sigma\n";
  for (std::size_t i = 0; i < truth_.scans.size(); ++i) {
    const auto p = written["scans"][i]["scanner"].get<std::vector<double>>();
    const Eigen::Vector3d scanner(p[0], p[1], p[2]);
    csv += truth_.scans[i].file + "," + numbers(scanner) + "," + numbers(truth_.scans[i].T_world_scan * scanner) +
           ",0.05\n";
  }
  folder_.write("gnss.csv", csv);
  const auto [wrong_with, registered_with] = wrong_and_registered({"--gnss", "gnss.csv"});
  EXPECT_EQ(wrong_with, 0);
  EXPECT_GE(registered_with, 3);
  const auto report = read_json(folder() / "out/report.json");
  EXPECT_TRUE(std::any_of(report["hypotheses"].begin(), report["hypotheses"].end(), [](const auto& h) {
    return h.contains("by_survey") && h["by_survey"].template get<double>() == -8;
  }));
}

#ifdef TCM_ICP_HAVE_PROJ
TEST_F(RegisterSurvey, AnyCodeOfTheDatabaseBecomesTextInLas) {
  std::string csv = "name,scan,x,y,z,X,Y,Z,sigma\n";
  Rng rng = make_stream(4, "codes");
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector3d place = pose(0) * noise(rng, 6);
    const std::string name = std::string("T") + std::to_string(k);
    csv += name + ",000.ply," + numbers(pose(0).inverse() * place) + "," + numbers(place) + ",0.003\n";
  }
  folder_.write("control.csv", csv);
  const auto run_with = [&](const std::string& crs) {
    return run(Words{"register"} + town_scans({0, 1}) +
               Words{"--out", "out", "--force", "--control", "control.csv", "--format", "las", "--crs", crs} + kSmall);
  };
  RunResult result = run_with("EPSG:31467");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string text = ScanReader(folder() / "out/registered.las").coordinate_system();
  EXPECT_TRUE(text.starts_with("PROJCS[\"DHDN / 3-degree Gauss-Kruger zone 3\"")) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos);
  EXPECT_EQ(read_pose_file(folder() / "out/poses.json").crs, "EPSG:31467");
  result = run_with("EPSG:999999");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("does not name the coordinate system EPSG:999999"), std::string::npos) << result.err;
  EXPECT_EQ(ScanReader(folder() / "out/registered.las").coordinate_system(), "");
}
#endif

TEST_F(RegisterSurvey, WithoutControlOnItsScansTheFrameIsTheReferences) {
  folder_.write("control.csv", "name,scan,x,y,z,X,Y,Z,sigma,use\nC,000.ply,1,2,3,4,5,6,0.01,check\n");
  const RunResult result =
      run(Words{"register"} + town_scans({0, 1, 2}) + Words{"--out", "out", "--control", "control.csv"} + kSmall);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("the frame is that of the reference scan"), std::string::npos) << result.err;
  EXPECT_EQ(read_pose_file(folder() / "out/poses.json").frame, "");
}

using RegisterSurveyOptions = RegisterSurvey;

TEST_F(RegisterSurveyOptions, RefuseWhatMakesNoSense) {
  const Words start = Words{"register"} + town_scans({0, 1}) + Words{"--out", "out"};
  folder_.write("control.csv", "name,scan,x,y,z,X,Y,Z,sigma\nT,000.ply,1,2,3,4,5,6,0.01\n");
  folder_.write("bad.csv", "name,scan,x,y,z,X,Y,Z,sigma\nT,007.ply,1,2,3,4,5,6,0.01\n");
  folder_.write("words.wkt", "somewhere\n");
  const Words control = start + Words{"--control", "control.csv"};
  expect_refusal(start + Words{"--control", "none.csv"}, 2, {"none.csv", "cannot be opened"});
  expect_refusal(start + Words{"--control", "bad.csv"}, 2, {"bad.csv", "line 2", "007.ply", "000.ply"});
  folder_.write("gnss.csv", "scan,X,Y,sigma\n000.ply,1,2,0.5\n");
  expect_refusal(start + Words{"--gnss", "gnss.csv"}, 2, {"gnss.csv", "no column 'Z'"});
  expect_refusal(start + Words{"--fix", "000.ply"}, 1, {"--fix 000.ply", "--init"});
  expect_refusal(start + Words{"--crs", "EPSG:25832"}, 1, {"--crs", "--control"});
  expect_refusal(start + Words{"--level-sigma", "1"}, 1, {"--level-sigma", "--control"});
  expect_refusal(control + Words{"--crs", "Gauss"}, 1, {"--crs 'Gauss'", "EPSG:n"});
  expect_refusal(control + Words{"--crs", "words.wkt"}, 2, {"words.wkt", "no coordinate system"});
  expect_refusal(control + Words{"--level-sigma", "90"}, 1, {"--level-sigma", "90"});
  expect_refusal(control + Words{"--level-sigma", "0.01", "--level-sigma", "001.ply=little"}, 1,
                 {"--level-sigma 001.ply=little", "SCAN=DEGREES"});
  expect_refusal(control + Words{"--level-sigma", "007.ply=0.01"}, 1, {"--level-sigma 007.ply=0.01", "'007.ply'"});
  expect_refusal(control + Words{"--profile", "paper"}, 1, {"--profile robust"});
  expect_refusal(control + Words{"--method", "icp"}, 1, {"--method"});
}

}  // namespace
}  // namespace tcm_icp::test
