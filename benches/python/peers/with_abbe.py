import abbe

ur5 = abbe.load("ur5")

pose = ur5.pose
joint_jacobian = ur5.joint_jacobian
error_jacobian = ur5.error_jacobian
